// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <cstdint>

namespace groundglass {

// Red grows to the right, green downwards, blue is 100.
inline Image8 ColourRamp(int width, int height) {
  Image8 image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.At(x, y)[0] = static_cast<uint8_t>(40 + 2 * x);
      image.At(x, y)[1] = static_cast<uint8_t>(50 + 3 * y);
      image.At(x, y)[2] = 100;
    }
  }
  return image;
}

}  // namespace groundglass
