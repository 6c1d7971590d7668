// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/align_photograph.h"
#include "register/edges/edge_samples.h"
#include "scene/tie_use.h"

#include <vector>

namespace groundglass {

// Follows keypoints through the photographs that may be refined together (MatchWithColmap on pairs
// that see the same faces, FollowMatches), and gives the tracks to each of them. Throws Error in
// one line if COLMAP is missing or fails; the alignments are as they were then.
TieUse::Colmap AddColmapTracks(const EdgeModel& edge_model,
                               const ColmapOptions& options,
                               std::vector<PhotographAlignment>& alignments);

}  // namespace groundglass
