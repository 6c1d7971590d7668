// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace groundglass {

// Pixels, row by row from the top, channels interleaved. Names at the point of use say what the
// values are: radiance (linear light), srgb8, labels.
template <typename T>
struct Raster {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<T> values;

  Raster() = default;
  Raster(int width_, int height_, int channels_, T fill = T())
      : width(width_),
        height(height_),
        channels(channels_),
        values(static_cast<size_t>(width_) * height_ * channels_, fill) {}

  bool Empty() const { return values.empty(); }
  T* At(int x, int y) { return &values[(static_cast<size_t>(y) * width + x) * channels]; }
  const T* At(int x, int y) const {
    return &values[(static_cast<size_t>(y) * width + x) * channels];
  }
};

using ImageF = Raster<float>;      // linear light unless its name says otherwise
using Image8 = Raster<uint8_t>;    // sRGB, or codes
using Image16 = Raster<uint16_t>;  // labels, or 16-bit sRGB

}  // namespace groundglass
