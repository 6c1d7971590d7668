// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera_prior.h"
#include "register/refine.h"
#include "register/register_photograph.h"
#include "scene/registration.h"

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

// Writes verdict and reasons into a registration whose figures are filled in, except what
// JudgeChange writes. rival: the best solution elsewhere, if any, and how far away it lies.
void JudgeFit(const Solution& best,
              const Solution* rival,
              double rival_distance_px,
              const RegisterOptions& options,
              Registration& registration);

// Adds what the change from prior to solution says: the undetermined parameters, and `review` where
// the change is larger than the tag's sigmas allow. whitened: the solution.
void JudgeChange(const CameraParameters& whitened,
                 const CameraPrior& prior,
                 const RegisterOptions& options,
                 Registration& registration);

// Adds `review` where the model's points stay less certain than this, px at a width of 640. The
// last to judge: other photographs may have made them certain.
void JudgeCertainty(double max_vertex_sigma_px, Registration& registration);

}  // namespace groundglass
