// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <vector>

namespace groundglass {

// Which photograph textures each block of a chart.
struct ChartChoice {
  std::vector<int> best;           // per block: k in ChartBlocks::photos, or -1
  std::vector<float> consistency;  // [block * photos.size() + k]: 1 agrees with the consensus,
                                   // towards 0 something else stands there, or it is blurred
};

}  // namespace groundglass
