// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera_prior.h"
#include "register/find_solutions.h"
#include "register/register_photograph.h"
#include "scene/registration.h"

#include <optional>

namespace groundglass {

// What speaks for a camera: its score, and how much better it is than the best solution elsewhere,
// if there is one, and how far away that lies.
struct Evidence {
  AlignmentScore score;
  std::optional<double> margin_nats;
  double rival_distance_px = 0;  // of the photograph
};

// These lower a registration's verdict, which starts as `accepted`, with the reason, and never
// raise it.

// Writes score and margin, and judges them.
void JudgeEvidence(const Evidence& evidence,
                   const RegisterOptions& options,
                   Registration& registration);

// Judges how far the refinement came.
void JudgeOutcome(Refinement::Outcome outcome, Registration& registration);

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
