// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <cstdint>
#include <vector>

namespace groundglass {

// Which face each pixel of a photograph shows, and how far the pixel is from what must not be
// printed on it. Kept in tiles of 8 x 8, and those that are alike all over take eight bytes: a
// photograph of 24 MP takes some 10 MB.
class SightMap {
 public:
  struct Pixel {
    uint16_t label = 0;  // face from 1; 0: none
    uint8_t border = 0;  // steps of 1 / kBorderStepsPerPx; 0: not to be printed
    bool operator==(const Pixel&) const = default;
  };

  SightMap() = default;
  // Distances beyond `most_border` are all alike.
  SightMap(const Image16& labels, const Image8& border, int most_border);

  int width() const { return width_; }
  int height() const { return height_; }
  size_t NumBytes() const { return tiles_.size() * sizeof(Tile) + pixels_.size() * sizeof(Pixel); }
  Pixel At(int x, int y) const {
    const Tile& tile = tiles_[static_cast<size_t>(y / kTile) * columns_ + x / kTile];
    if (tile.first < 0) return tile.all;
    return pixels_[tile.first + y % kTile * kTile + x % kTile];
  }
  // Whether some pixel shows each face, indexed by label - 1.
  std::vector<char> ShownFaces(size_t num_faces) const;

 private:
  static constexpr int kTile = 8;
  struct Tile {
    int32_t first = -1;  // in pixels_; -1: all pixels are `all`
    Pixel all;
  };
  int width_ = 0;
  int height_ = 0;
  int columns_ = 0;
  std::vector<Tile> tiles_;
  std::vector<Pixel> pixels_;
};

}  // namespace groundglass
