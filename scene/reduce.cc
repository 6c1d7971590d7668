// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/reduce.h"

#include "scene/srgb.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

namespace groundglass {
namespace {

// What of one axis goes where: each old pixel's first new one, and how much of it lies there; the
// rest lies in the next.
struct Share {
  int first = 0;
  float in_first = 1;
  float in_next = 0;
};

// Shares sum to 1 for each new pixel.
std::vector<Share> SharesOf(int from, int to) {
  std::vector<Share> shares(static_cast<size_t>(from));
  const double scale = static_cast<double>(to) / from;
  for (int i = 0; i < from; ++i) {
    Share& share = shares[static_cast<size_t>(i)];
    // In whole numbers, so that a border between new pixels is met exactly.
    share.first = static_cast<int>(static_cast<long long>(i) * to / from);
    const double border = std::min((share.first + 1) / scale, i + 1.0);
    share.in_first = static_cast<float>((border - i) * scale);
    share.in_next = static_cast<float>((i + 1 - border) * scale);
    if (share.first + 1 >= to) share.in_next = 0;
  }
  return shares;
}

}  // namespace

Image8 ReducedInLight(const Image8& srgb8, int width, int height) {
  assert(width >= 1 && height >= 1 && width <= srgb8.width && height <= srgb8.height);
  if (width == srgb8.width && height == srgb8.height) return srgb8;
  const std::array<float, 256>& light_of_code = LinearOfSrgb8();
  const std::vector<Share> across = SharesOf(srgb8.width, width);
  const std::vector<Share> down = SharesOf(srgb8.height, height);
  const int channels = srgb8.channels;
  const size_t row_size = static_cast<size_t>(width) * channels;
  // One new pixel more, which takes the nothing that the last old pixel has left over.
  std::vector<float> row(row_size + channels);
  std::vector<float> here(row_size, 0.f);
  std::vector<float> next(row_size, 0.f);
  Image8 reduced(width, height, channels);
  for (int y = 0; y < srgb8.height; ++y) {
    std::fill(row.begin(), row.end(), 0.f);
    const uint8_t* code = srgb8.At(0, y);
    for (const Share& share : across) {
      float* at = &row[static_cast<size_t>(share.first) * channels];
      for (int c = 0; c < channels; ++c) {
        const float light = light_of_code[*code++];
        at[c] += share.in_first * light;
        at[c + channels] += share.in_next * light;
      }
    }
    const Share& share = down[static_cast<size_t>(y)];
    for (size_t i = 0; i < row_size; ++i) {
      here[i] += share.in_first * row[i];
      next[i] += share.in_next * row[i];
    }
    if (y + 1 < srgb8.height && down[static_cast<size_t>(y + 1)].first == share.first) continue;
    uint8_t* to = reduced.At(0, share.first);
    for (size_t i = 0; i < row_size; ++i) {
      to[i] = Srgb8FromLinear(here[i]);
    }
    here.swap(next);
    std::fill(next.begin(), next.end(), 0.f);
  }
  return reduced;
}

}  // namespace groundglass
