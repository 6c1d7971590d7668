// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/joint/aligned_photograph.h"
#include "register/joint/joint_solution.h"
#include "register/ties/tie_points.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// What joint refinement is given, and what it gives.
struct JointStage {
  std::vector<std::string> names;  // of the photographs
  std::vector<int> widths_px;  // of the photographs themselves; they are aligned at a smaller one
  const std::vector<AlignedPhotograph>& photographs;
  const std::vector<int>& lenses;
  const std::vector<TiePoint>& ties;
  const JointRefinement& joint;
};

// Writes it to be looked at (docs/registration.md): all but the samples into folder/joint.json, the
// samples with their candidates into folder/NAME/joint_samples.csv. Places in pixels of the
// photographs and in `site`. Throws Error if a file cannot be written.
void KeepJointStage(const JointStage& stage, const std::filesystem::path& folder);

}  // namespace groundglass
