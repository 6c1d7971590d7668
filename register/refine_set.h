// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/align_photograph.h"

#include <vector>

namespace groundglass {

// Refines photographs together and judges them anew: those that are accepted by themselves, and
// those in `review` of which the others show the same (ties), each with its best camera or its
// second-best one, whichever edges and ties together speak for. Photographs of one camera name
// share a lens; without names, those of one size, view angle and aspect. What they share is k1, and
// with options.prior.digital view angle, aspect and shift as well. One that the others pull away
// from its own edges stays as it was found alone, and so do those with control points. Returns how
// far the model's edges were found from where the model has them; empty if fewer than two are
// refined, and then all stay as they are. Throws Error if there is no common solution.
std::vector<EdgeDisplacement> RefineSet(const EdgeModel& edge_model,
                                        const RegisterOptions& options,
                                        std::vector<PhotographAlignment>& alignments);

}  // namespace groundglass
