// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <cstdint>
#include <cstring>
#include <vector>

namespace groundglass {

// Which face each pixel of a photograph shows, and how far the pixel is from what must not be
// printed on it. Kept in tiles of 8 x 8: those that are alike all over take four bytes, others a
// byte a pixel for the distances and a bit or two a pixel for the faces, if there are few.
class VisibilityMap {
 public:
  struct Pixel {
    uint16_t label = 0;  // face from 1; 0: none
    uint8_t border = 0;  // steps of 1 / kBorderStepsPerPx; 0: not to be printed
    bool operator==(const Pixel&) const = default;
  };

  VisibilityMap() = default;
  // Distances beyond `most_border` are all alike.
  VisibilityMap(const Image16& labels, const Image8& border, int most_border);

  int width() const { return width_; }
  int height() const { return height_; }
  size_t NumBytes() const { return tiles_.size() * sizeof(uint32_t) + bytes_.size(); }
  // Of these, what tiles take that are alike all over, and the places of the others.
  size_t NumTileBytes() const { return tiles_.size() * sizeof(uint32_t); }
  Pixel At(int x, int y) const {
    const uint32_t tile = tiles_[static_cast<size_t>(y / kTile) * columns_ + x / kTile];
    if ((tile & kIsMixed) == 0) {
      return {static_cast<uint16_t>(tile), static_cast<uint8_t>(tile >> 16)};
    }
    return AtMixed(&bytes_[static_cast<size_t>(tile & ~kIsMixed) * kUnit],
                   y % kTile * kTile + x % kTile);
  }
  // Whether some pixel shows each face, indexed by label - 1.
  std::vector<bool> ShownFaces(size_t num_faces) const;

 private:
  static constexpr int kTile = 8;
  static constexpr int kPixels = kTile * kTile;
  // Of a tile that is alike all over: the label below, the border above. Of a mixed one, where it
  // starts in bytes_, in kUnit bytes: one byte says how many bits a pixel its faces take (0, 1, 2
  // or 16), one whether the border is the same all over, then 1, 2 or 4 labels and the bits, or 64
  // labels, and 1 or 64 borders.
  static constexpr uint32_t kIsMixed = 1u << 31;
  static constexpr size_t kUnit = 2;

  static uint16_t LabelIn(const uint8_t* labels, int index) {
    uint16_t label = 0;
    std::memcpy(&label, labels + 2 * index, 2);
    return label;
  }
  static Pixel AtMixed(const uint8_t* tile, int pixel) {
    const int bits = tile[0];
    const uint8_t* labels = tile + 2;
    const uint8_t* borders = labels + 2 * kPixels;
    int index = pixel;
    if (bits < 16) {
      const uint8_t* packed = labels + (2 << bits);
      index = packed[pixel * bits / 8] >> (pixel * bits % 8) & ((1 << bits) - 1);
      borders = packed + kPixels * bits / 8;
    }
    return {LabelIn(labels, index), borders[tile[1] != 0 ? 0 : pixel]};
  }
  // Appends a mixed tile; returns where it starts, in units.
  uint32_t AddMixed(const Pixel* pixels);

  int width_ = 0;
  int height_ = 0;
  int columns_ = 0;
  std::vector<uint32_t> tiles_;
  std::vector<uint8_t> bytes_;
};

}  // namespace groundglass
