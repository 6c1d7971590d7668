// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/edges/edge_evidence.h"
#include "register/refine/find_solutions.h"
#include "scene/image.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// What the stages of one photograph's registration have handed to one another.
struct AlignmentStages {
  const std::string& name;  // of the photograph
  const Image8& grey8;      // the photograph itself
  const EdgeModel& edge_model;
  const CameraPrior& prior;
  const EdgeEvidence& evidence;
  const std::vector<Solution>& solutions;  // best first; may be empty
};

// Writes them into folder/NAME, to be looked at (docs/registration.md): samples of the tag's camera
// and of the one found, solutions with the hypotheses that they come from, the matches about the
// camera found, and a picture of samples and candidates. Places in pixels of the photograph and in
// `site`. Throws Error if a file cannot be written.
void KeepStages(const AlignmentStages& stages,
                const SolutionOptions& options,
                const std::filesystem::path& folder);

}  // namespace groundglass
