// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/photos/visibility_map.h"

#include <algorithm>

namespace groundglass {

VisibilityMap::VisibilityMap(const Image16& labels, const Image8& border, int most_border)
    : width_(labels.width), height_(labels.height), columns_((labels.width + kTile - 1) / kTile) {
  const int rows = (height_ + kTile - 1) / kTile;
  tiles_.reserve(static_cast<size_t>(columns_) * rows);
  Pixel pixels[kPixels];
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns_; ++column) {
      bool is_uniform = true;
      for (int j = 0; j < kTile; ++j) {
        // Beyond the frame the last pixels are repeated.
        const int y = std::min(row * kTile + j, height_ - 1);
        for (int i = 0; i < kTile; ++i) {
          const int x = std::min(column * kTile + i, width_ - 1);
          Pixel& pixel = pixels[j * kTile + i];
          pixel.label = *labels.At(x, y);
          pixel.border = static_cast<uint8_t>(std::min<int>(*border.At(x, y), most_border));
          is_uniform = is_uniform && pixel == pixels[0];
        }
      }
      tiles_.push_back(is_uniform ? pixels[0].label | pixels[0].border << 16
                                  : AddMixed(pixels) | kIsMixed);
    }
  }
  bytes_.shrink_to_fit();
}

uint32_t VisibilityMap::AddMixed(const Pixel* pixels) {
  constexpr int kMostInPalette = 4;
  uint16_t palette[kMostInPalette] = {};
  int index[kPixels];
  int num_labels = 0;
  bool is_border_uniform = true;
  for (int i = 0; i < kPixels; ++i) {
    is_border_uniform = is_border_uniform && pixels[i].border == pixels[0].border;
    if (num_labels > kMostInPalette) continue;
    index[i] =
        static_cast<int>(std::find(palette, palette + num_labels, pixels[i].label) - palette);
    if (index[i] < num_labels) continue;
    if (num_labels < kMostInPalette) palette[num_labels] = pixels[i].label;
    ++num_labels;
  }
  const int bits = num_labels == 1 ? 0 : num_labels == 2 ? 1 : num_labels <= 4 ? 2 : 16;
  const size_t start = bytes_.size();
  bytes_.push_back(static_cast<uint8_t>(bits));
  bytes_.push_back(is_border_uniform ? 1 : 0);
  const auto add_label = [&](uint16_t label) {
    const size_t at = bytes_.size();
    bytes_.resize(at + 2);
    std::memcpy(&bytes_[at], &label, 2);
  };
  if (bits == 16) {
    for (int i = 0; i < kPixels; ++i) add_label(pixels[i].label);
  } else {
    for (int i = 0; i < 1 << bits; ++i) add_label(palette[i]);
    const size_t packed = bytes_.size();
    bytes_.resize(packed + kPixels * bits / 8);
    for (int i = 0; i < kPixels && bits > 0; ++i) {
      bytes_[packed + i * bits / 8] |= static_cast<uint8_t>(index[i] << (i * bits % 8));
    }
  }
  for (int i = 0; i < (is_border_uniform ? 1 : kPixels); ++i) bytes_.push_back(pixels[i].border);
  if (bytes_.size() % kUnit != 0) bytes_.push_back(0);
  return static_cast<uint32_t>(start / kUnit);
}

std::vector<bool> VisibilityMap::ShownFaces(size_t num_faces) const {
  std::vector<bool> is_shown(num_faces, false);
  const auto add = [&](int label) {
    if (label != 0) is_shown.at(label - 1) = true;
  };
  for (const uint32_t tile : tiles_) {
    if ((tile & kIsMixed) == 0) {
      add(static_cast<uint16_t>(tile));
      continue;
    }
    const uint8_t* mixed = &bytes_[static_cast<size_t>(tile & ~kIsMixed) * kUnit];
    for (int i = 0; i < kPixels; ++i) add(AtMixed(mixed, i).label);
  }
  return is_shown;
}

}  // namespace groundglass
