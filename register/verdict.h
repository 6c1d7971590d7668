// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera_prior.h"
#include "register/find_solutions.h"
#include "register/register_photograph.h"
#include "scene/registration.h"

namespace groundglass {

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
