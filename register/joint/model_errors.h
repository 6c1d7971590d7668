// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/edges/edge_samples.h"
#include "register/joint/joint_refinement.h"
#include "scene/registration.h"

#include <string>
#include <vector>

namespace groundglass {

struct ModelErrorOptions {
  // A line is reported if at least this many photographs show it, and it was found this far away,
  // in standard deviations of its displacement and in sigmas of the model (0.03 m for a building).
  int min_photographs = 3;
  double min_sigmas = 4;
  double min_offset_sigmas = 0.04 / 0.03;
  // Lines of one wall or level are off as one if they differ by less than this share of it.
  double same_offset_share = 0.3;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "model error options: ") const;
};

// The lines that are off in all photographs that show them, the farthest first, and each followed
// by those that are off as one with it. names: of the photographs.
std::vector<ModelError> FindModelErrors(const EdgeModel& edge_model,
                                        const std::vector<EdgeDisplacement>& displacements,
                                        const std::vector<std::string>& names,
                                        const ModelErrorOptions& options);

}  // namespace groundglass
