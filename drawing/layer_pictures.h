// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "drawing/drawing_layers.h"
#include "scene/image.h"

#include <array>
#include <string>
#include <vector>

namespace groundglass {

// A layer to look at: coarser than the drawing, in flat colours with their meanings.
struct LayerPicture {
  std::string name;
  Image8 srgb8;
  double pixel_size = 1;  // model's unit
  struct Entry {
    std::array<uint8_t, 3> colour;
    std::string meaning;
  };
  std::vector<Entry> legend;
};

// Which photograph each place comes from: neighbouring numbers have hues far apart.
LayerPicture PicturePhotographs(const DrawingLayers& layers,
                                const DrawingGrid& grid,
                                const DrawingSources& sources);
// How sure each place is: five steps from the smallest standard deviation to the largest.
LayerPicture PictureSigmas(const DrawingLayers& layers, const DrawingGrid& grid);

}  // namespace groundglass
