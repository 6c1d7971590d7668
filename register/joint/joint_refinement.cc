// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/joint_refinement.h"

#include "register/joint/joint_covariance.h"
#include "register/joint/joint_state.h"
#include "register/joint/match_together.h"
#include "register/joint/solve_together.h"

#include <cmath>

namespace groundglass {

JointRefinement RefineTogether(const EdgeModel& edge_model,
                               const std::vector<AlignedPhotograph>& photographs,
                               const std::vector<int>& lenses,
                               const std::vector<TiePoint>& ties,
                               const JointOptions& options) {
  if (photographs.empty()) return {};
  JointState state(edge_model, photographs, lenses, ties, options);
  SolvedTogether solved;
  for (int round = 0; round < options.num_rounds; ++round) {
    if (round > 0 && round + 1 == options.num_rounds) {
      EstimateSharedOffset(options, state);
      EstimateGroupOffset(options, state);
    }
    MatchTogether(std::pow(options.shrink, round), options, state);
    solved = SolveTogether(options, state);
  }
  return SummariseTogether(state, solved);
}

}  // namespace groundglass
