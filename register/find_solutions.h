// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/register_photograph.h"

#include <vector>

namespace groundglass {

// One refined start with its score.
struct Solution {
  Refinement refinement;
  AlignmentScore score;
  double control_point_nats = 0;  // log density of what a person pointed at, 0 without

  // The log densities of the prior and of the control points join the edges' score.
  double TotalScore() const {
    return score.nats + control_point_nats - 0.5 * refinement.whitened.squaredNorm();
  }
};

// Where refinement ends from the starts that the search finds in the prior, best first; several may
// end at the same camera. Empty if the tag's camera sees almost nothing of the model.
// points: in pixels of the prior's picture.
std::vector<Solution> FindSolutions(const EdgeModel& edge_model,
                                    const EdgeEvidence& evidence,
                                    const CameraPrior& prior,
                                    const std::vector<ControlPoint>& points,
                                    const RegisterOptions& options);

// The best of the solutions that lie elsewhere than the first, with how far away it lies on
// average where the first sees edges, in pixels of the prior's picture; null if there is none.
struct Rival {
  const Solution* solution = nullptr;
  double distance_px = 0;
};
Rival FindRival(const std::vector<Solution>& solutions,
                const CameraPrior& prior,
                const RegisterOptions& options);

}  // namespace groundglass
