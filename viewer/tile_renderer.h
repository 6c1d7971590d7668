// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/formats/tile_file.h"
#include "scene/image.h"

#include <span>
#include <vector>

namespace groundglass {

// Draws tiles as the hardware of 1988 did: each is two triangles, and codes are interpolated
// between their corners (Gouraud 1971). Tiles may come in any order and in as many pieces as one
// likes, so that a database need not be in memory; what is nearest wins. A tile's back is not
// drawn.
class TileRenderer {
 public:
  // supersampling: 1 to 4 samples a pixel each way.
  TileRenderer(const Camera& camera, int supersampling);

  void Draw(std::span<const Tile> tiles);

  // sRGB on white, 3 channels.
  Image8 Picture() const;

 private:
  Camera camera_;  // of the samples
  int supersampling_;
  Image8 codes_;
  Raster<float> nearness_;  // 1 / depth; 0: nothing
};

}  // namespace groundglass
