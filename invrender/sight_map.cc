// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/sight_map.h"

#include <algorithm>

namespace groundglass {

SightMap::SightMap(const Image16& labels, const Image8& border, int most_border)
    : width_(labels.width), height_(labels.height), columns_((labels.width + kTile - 1) / kTile) {
  const int rows = (height_ + kTile - 1) / kTile;
  tiles_.reserve(static_cast<size_t>(columns_) * rows);
  Pixel pixels[kTile * kTile];
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns_; ++column) {
      for (int j = 0; j < kTile; ++j) {
        // Beyond the frame the last pixels are repeated.
        const int y = std::min(row * kTile + j, height_ - 1);
        for (int i = 0; i < kTile; ++i) {
          const int x = std::min(column * kTile + i, width_ - 1);
          pixels[j * kTile + i] = {
              *labels.At(x, y), static_cast<uint8_t>(std::min<int>(*border.At(x, y), most_border))};
        }
      }
      Tile& tile = tiles_.emplace_back();
      tile.all = pixels[0];
      if (std::any_of(pixels, std::end(pixels), [&](Pixel p) { return !(p == pixels[0]); })) {
        tile.first = static_cast<int32_t>(pixels_.size());
        pixels_.insert(pixels_.end(), pixels, std::end(pixels));
      }
    }
  }
  pixels_.shrink_to_fit();
}

std::vector<char> SightMap::ShownFaces(size_t num_faces) const {
  std::vector<char> is_shown(num_faces, 0);
  const auto add = [&](Pixel pixel) {
    if (pixel.label != 0) is_shown.at(pixel.label - 1) = 1;
  };
  for (const Tile& tile : tiles_) {
    if (tile.first < 0) add(tile.all);
  }
  for (const Pixel pixel : pixels_) add(pixel);
  return is_shown;
}

}  // namespace groundglass
