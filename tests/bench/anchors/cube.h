// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "tests/bench/anchors/anchor_set.h"

#include <filesystem>

namespace groundglass {

// ViSP's video of a printed cube of 84 mm on a table, 640 x 480, whose lens is known; 55 frames,
// every fourth. There is no truth: the reference is ViSP's own tracker, led through the whole video
// from the pose that comes with it.
struct Cube {
  AnchorSet set;
  // Mean over the frames of the vertex error between two references, tracked with different search
  // ranges and tests of hidden lines, px: how far the reference can be trusted at best.
  double reference_spread_px = 0;
};

// Reads it from `folder` (.../mbt). Throws Error.
Cube ReadCube(const std::filesystem::path& folder);

}  // namespace groundglass
