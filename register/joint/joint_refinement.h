// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/edges/edge_samples.h"
#include "register/joint/aligned_photograph.h"
#include "register/joint/joint_options.h"
#include "register/joint/joint_solution.h"
#include "register/ties/tie_points.h"

#include <vector>

namespace groundglass {

// Solves all photographs together: cameras with their priors, the lens that photographs share, and
// where each model edge really is, so that a cornice that the model has a hand too low drags no
// camera. Starts are the photographs' own solutions. lenses: for each photograph, the number of its
// lens, from 0. ties: what photographs see alike, by their numbers here; may be empty.
// Deterministic. Throws Error if the solver finds no solution.
JointRefinement RefineTogether(const EdgeModel& edge_model,
                               const std::vector<AlignedPhotograph>& photographs,
                               const std::vector<int>& lenses,
                               const std::vector<TiePoint>& ties,
                               const JointOptions& options);

}  // namespace groundglass
