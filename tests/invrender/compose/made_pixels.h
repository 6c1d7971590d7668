// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/compose/chart_pixels.h"
#include "scene/textured_model.h"

#include <algorithm>
#include <string>
#include <vector>

namespace groundglass {

// A chart's texels drawn as text: ' ' outside, '.' open, 'w' weak, 'g' good; weak and good ones are
// photograph 1's, of one grey.
inline ChartPixels MakePixels(const std::vector<std::string>& rows, uint8_t grey = 100) {
  const int width = static_cast<int>(rows[0].size());
  const int height = static_cast<int>(rows.size());
  ChartPixels pixels;
  pixels.srgb8 = Image8(width, height, 3);
  pixels.provenance = Image16(width, height, 1);
  pixels.states = Raster<uint8_t>(width, height, 1);
  pixels.reach = Raster<uint8_t>(width, height, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto state = static_cast<TexelState>(std::string(" .wg").find(rows[y][x]));
      *pixels.states.At(x, y) = static_cast<uint8_t>(state);
      if (state != TexelState::kWeak && state != TexelState::kGood) continue;
      std::fill_n(pixels.srgb8.At(x, y), 3, grey);
      *pixels.provenance.At(x, y) = 1;
    }
  }
  return pixels;
}

// The states as they were drawn.
inline std::vector<std::string> StatesOf(const ChartPixels& pixels) {
  std::vector<std::string> rows(pixels.states.height);
  for (int y = 0; y < pixels.states.height; ++y) {
    for (int x = 0; x < pixels.states.width; ++x) rows[y] += " .wg"[*pixels.states.At(x, y)];
  }
  return rows;
}

}  // namespace groundglass
