// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "tests/bench/anchors/anchor_set.h"
#include "tests/bench/anchors/visp_edge_tracker.h"

#include <string>

namespace groundglass {

// Writes the set's model as a file, which is all that the tracker reads, and returns its path.
std::string WriteCao(const AnchorSet& set);

// Tracks one picture from `start`, whose lens is taken as known. `settings` gives search ranges,
// repeats and the test of hidden lines; the rest is filled in.
Camera TrackWithVisp(const AnchorSet& set,
                     const std::string& cao_file,
                     const Image8& grey8,
                     const Camera& start,
                     VispTracking settings);

}  // namespace groundglass
