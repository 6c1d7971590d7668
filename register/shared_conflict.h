// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/align_photograph.h"

#include <optional>
#include <vector>

namespace groundglass {

// Whether the parts of the model's drawing disagree on a photograph's camera (FindEdgeConflict),
// its edges moved by so much (none: as they are drawn).
std::optional<EdgeConflict> FindConflictOf(const AlignedPhotograph& photograph,
                                           const std::vector<Eigen::Vector3d>& edge_moves_in_world,
                                           const EdgeModel& edge_model,
                                           const RegisterOptions& options);

// `review` for the accepted photographs in which parts of the model's drawing disagree, if these
// are options.least_share of all that are accepted: then the model is to blame, and no photograph
// by itself can tell which part is in its place.
void JudgeSharedConflict(const ConflictOptions& options,
                         std::vector<PhotographAlignment>& alignments);

}  // namespace groundglass
