// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "tests/bench/anchors/anchor_set.h"

#include <filesystem>

namespace groundglass {

// ViSP's rendered sequence Castle-simu: 40 frames of 640 x 480 with exact poses, of a tower with a
// yard. ViSP's frame has y up: world = 100 (x, -z, y).
//
// Reads it from `folder` (.../mbt-depth/Castle-simu). Throws Error. The model is chateau.wrl's: all
// polygons of the castle, exact; chateau.cao has five of them and one coordinate off by 3 mm.
AnchorSet ReadCastle(const std::filesystem::path& folder);

}  // namespace groundglass
