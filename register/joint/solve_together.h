// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/joint/joint_state.h"

#include <ceres/problem.h>

#include <memory>
#include <vector>

namespace groundglass {

// The problem as it was solved; its parameters are the state's.
struct SolvedTogether {
  std::unique_ptr<ceres::Problem> problem;
  std::vector<ceres::ResidualBlockId> edge_costs;  // one for each of JointState::runs
  // One for each observation of each of JointState::tie_points, in order.
  std::vector<ceres::ResidualBlockId> tie_costs;
};

// Moves cameras, lenses and edges, candidates held. Throws Error if the solver finds no solution.
SolvedTogether SolveTogether(const JointOptions& options, JointState& state);

}  // namespace groundglass
