// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

namespace groundglass {

struct FloodOptions {
  // Flooding goes from pixel to pixel as long as no channel of the picture, evened out over 3 x 3
  // pixels, changes by more than the first from one to the next, or by more than the second from
  // where it began; sRGB codes. Larger leaks over weak edges.
  int step = 6;
  int range = 48;

  void Check() const;  // throws Error naming the first field out of range
};

// What of a picture (3 channels) lies around a place up to the edges that it shows: 255, the rest
// 0; an empty picture if the place is outside. A scan of 24 megapixels takes up to a second.
Image8 FindFlood(const Image8& srgb8,
                 const Eigen::Vector2d& from_px,
                 const FloodOptions& options = {});

}  // namespace groundglass
