// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// Side of a block in texels. Colour, consensus and choice are settled on blocks; texels only
// follow.
constexpr int kBlockTexels = 5;

// One block as one photograph shows it.
struct BlockView {
  float quality = 0;         // 0: not seen
  float radius_squared = 0;  // PreparedPhoto::RadiusSquared
  bool is_usable = false;    // neither burnt out nor black, and clear of borders
  Eigen::Array3f log_radiance = Eigen::Array3f::Zero();  // natural logarithm
};

// What every photograph shows of one chart, coarsely.
struct ChartBlocks {
  int width = 0;  // blocks
  int height = 0;
  std::vector<int> photos;       // those that see some of the chart, ascending
  std::vector<BlockView> views;  // [block * photos.size() + k]

  int NumBlocks() const { return width * height; }
  const BlockView* ViewsOf(int block) const { return &views[block * photos.size()]; }
};

}  // namespace groundglass
