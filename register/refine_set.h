// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/align_photograph.h"
#include "register/surveyed_tags_in_set.h"
#include "scene/formats/tag_corners.h"

#include <vector>

namespace groundglass {

// Refines photographs together and judges them anew: those that are accepted by themselves, and
// those in `review` of which the others show the same (ties), each with its best camera or its
// second-best one, whichever edges and ties together speak for. Photographs of one camera name
// share a lens; without names, those of one size, view angle and aspect. What they share is k1, and
// with options.prior.digital view angle, aspect and shift as well. One that the others pull away
// from its own edges stays as it was found alone, and so do those with control points. Returns how
// far the model's edges were found from where the model has them, with the places among alignments
// of those that show each; empty if fewer than two are
// refined, and then all stay as they are. Throws Error if there is no common solution.
// tag_corners: of AprilTags that were surveyed, in pixels of the photographs; each is a point whose
// place is known to the survey's sigma. moved_tags, if given, receives those that are not there.
std::vector<EdgeDisplacement> RefineSet(const EdgeModel& edge_model,
                                        const RegisterOptions& options,
                                        std::vector<PhotographAlignment>& alignments,
                                        const std::vector<SeenTagCorner>& tag_corners = {},
                                        std::vector<MovedTag>* moved_tags = nullptr);

}  // namespace groundglass
