// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/align_photograph.h"

#include <vector>

namespace groundglass {

// Refines the accepted photographs together (RefineTogether) and writes what came of it into their
// registrations: cameras, covariances, scores and margins, and `review` for one whose change has
// become larger than its tag's sigmas allow, or whose score or margin too small. Photographs of one
// camera name share a lens; without names, those of one size, view angle and aspect. What they
// share is k1, and with options.prior.digital view angle and aspect as well. Photographs with
// control points stay as they are. Returns how far the model's edges were found from where the
// model has them; empty for fewer than two photographs.
std::vector<EdgeDisplacement> RefineAccepted(const EdgeModel& edge_model,
                                             const RegisterOptions& options,
                                             std::vector<PhotographAlignment>& alignments);

}  // namespace groundglass
