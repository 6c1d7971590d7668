// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/colour/colour.h"
#include "invrender/inputs/bake_options.h"
#include "invrender/measure/sharpness.h"
#include "invrender/measure/texel_blocks.h"

#include <vector>

namespace groundglass {

// Which photograph textures each block of a chart.
struct ChartChoice {
  std::vector<int> best;           // per block: k in ChartBlocks::photos, or -1
  std::vector<float> consistency;  // [block * photos.size() + k]: 1 agrees with the consensus,
                                   // towards 0 something else stands there, or it is blurred
};

// Picks by resolution, angle and distance to borders (CellView::quality), against photographs that
// differ from the consensus of the others or are blurred (`sharpness`: for each photograph; empty:
// all alike); then seams are smoothed.
ChartChoice ChooseBlocks(const ChartBlocks& blocks,
                         int chart,
                         const ColourModel& colour,
                         const std::vector<Sharpness>& sharpness,
                         const BakeOptions& options);

}  // namespace groundglass
