// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/colour/colour.h"
#include "invrender/measure/texel_blocks.h"

#include <Eigen/Dense>

namespace groundglass {

// Blocks of a chart that photographs 0, 1, ... all see equally well, all of one grey.
inline ChartBlocks MakeBlocks(int width, int height, int num_photos, float log_radiance = -1) {
  ChartBlocks blocks;
  blocks.width = width;
  blocks.height = height;
  for (int k = 0; k < num_photos; ++k) blocks.photos.push_back(k);
  BlockView view;
  view.quality = 1;
  view.is_usable = true;
  view.log_radiance = Eigen::Array3f::Constant(log_radiance);
  blocks.views.assign(static_cast<size_t>(width) * height * num_photos, view);
  return blocks;
}

inline BlockView& ViewAt(ChartBlocks& blocks, int x, int y, int k) {
  return blocks.views[(static_cast<size_t>(y) * blocks.width + x) * blocks.photos.size() + k];
}

// No gains at all.
inline ColourModel Neutral(const ChartBlocks& blocks) {
  return MakeNeutralColour({blocks}, blocks.photos.size());
}

}  // namespace groundglass
