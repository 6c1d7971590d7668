// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/photo_pyramid.h"

#include "scene/cubic_weights.h"
#include "scene/image_io.h"
#include "scene/srgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

const std::array<float, 256>& RadianceTable() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values;
    for (int i = 0; i < 256; ++i) values[i] = LinearFromSrgb(i / 255.0f);
    return values;
  }();
  return table;
}

constexpr int kEncodeSteps = 16384;
const std::vector<uint8_t>& EncodeTable() {
  static const std::vector<uint8_t> table = [] {
    std::vector<uint8_t> codes(kEncodeSteps + 1);
    for (int i = 0; i <= kEncodeSteps; ++i) {
      const float encoded = SrgbFromLinear(static_cast<float>(i) / kEncodeSteps);
      codes[i] = static_cast<uint8_t>(std::lround(255 * encoded));
    }
    return codes;
  }();
  return table;
}

Image8 Halve(const Image8& full) {
  Image8 half(std::max(1, full.width / 2), std::max(1, full.height / 2), 3);
  const std::array<float, 256>& radiance = RadianceTable();
  tbb::parallel_for(0, half.height, [&](int y) {
    const int y0 = 2 * y;
    const int y1 = std::min(2 * y + 1, full.height - 1);
    for (int x = 0; x < half.width; ++x) {
      const int x0 = 2 * x;
      const int x1 = std::min(2 * x + 1, full.width - 1);
      for (int c = 0; c < 3; ++c) {
        const float sum = radiance[full.At(x0, y0)[c]] + radiance[full.At(x1, y0)[c]] +
                          radiance[full.At(x0, y1)[c]] + radiance[full.At(x1, y1)[c]];
        half.At(x, y)[c] = Srgb8FromRadiance(sum / 4);
      }
    }
  });
  return half;
}

}  // namespace

uint8_t Srgb8FromRadiance(float radiance) {
  const float clamped = std::clamp(radiance, 0.0f, 1.0f);
  return EncodeTable()[static_cast<int>(clamped * kEncodeSteps + 0.5f)];
}

float RadianceFromSrgb8(uint8_t srgb8) { return RadianceTable()[srgb8]; }

PhotoPyramid::PhotoPyramid(Image8 srgb8) {
  levels_.push_back(std::move(srgb8));
  while (std::min(levels_.back().width, levels_.back().height) >= 8) {
    levels_.push_back(Halve(levels_.back()));
  }
}

size_t PhotoPyramid::NumBytes() const {
  size_t num_bytes = 0;
  for (const Image8& level : levels_) num_bytes += level.values.size();
  return num_bytes;
}

Eigen::Array3f PhotoPyramid::Bicubic(const Image8& level, double x, double y) const {
  const std::array<float, 256>& radiance = RadianceTable();
  const double fx = std::floor(x - 0.5);
  const double fy = std::floor(y - 0.5);
  const std::array<float, 4> wx = CubicWeights(static_cast<float>(x - 0.5 - fx));
  const std::array<float, 4> wy = CubicWeights(static_cast<float>(y - 0.5 - fy));
  const int x0 = static_cast<int>(fx) - 1;
  const int y0 = static_cast<int>(fy) - 1;
  // Where the four columns start in a row, clamped at the frame.
  std::array<int, 4> columns;
  for (int i = 0; i < 4; ++i) columns[i] = 3 * std::clamp(x0 + i, 0, level.width - 1);
  std::array<float, 3> sum = {0, 0, 0};
  for (int j = 0; j < 4; ++j) {
    const uint8_t* row = level.At(0, std::clamp(y0 + j, 0, level.height - 1));
    std::array<float, 3> in_row = {0, 0, 0};
    for (int i = 0; i < 4; ++i) {
      const uint8_t* pixel = row + columns[i];
      for (int c = 0; c < 3; ++c) in_row[c] += wx[i] * radiance[pixel[c]];
    }
    for (int c = 0; c < 3; ++c) sum[c] += wy[j] * in_row[c];
  }
  return {std::max(sum[0], 0.0f), std::max(sum[1], 0.0f), std::max(sum[2], 0.0f)};
}

Eigen::Array3f PhotoPyramid::Bilinear(const Image8& level, double x, double y) const {
  const std::array<float, 256>& radiance = RadianceTable();
  const double fx = std::floor(x - 0.5);
  const double fy = std::floor(y - 0.5);
  const float tx = static_cast<float>(x - 0.5 - fx);
  const float ty = static_cast<float>(y - 0.5 - fy);
  const int x0 = std::clamp(static_cast<int>(fx), 0, level.width - 1);
  const int y0 = std::clamp(static_cast<int>(fy), 0, level.height - 1);
  const int x1 = std::clamp(static_cast<int>(fx) + 1, 0, level.width - 1);
  const int y1 = std::clamp(static_cast<int>(fy) + 1, 0, level.height - 1);
  const auto at = [&](int px, int py) {
    const uint8_t* pixel = level.At(px, py);
    return Eigen::Array3f(radiance[pixel[0]], radiance[pixel[1]], radiance[pixel[2]]);
  };
  return (1 - ty) * ((1 - tx) * at(x0, y0) + tx * at(x1, y0)) +
         ty * ((1 - tx) * at(x0, y1) + tx * at(x1, y1));
}

Eigen::Array3f PhotoPyramid::Sample(const Eigen::Vector2d& image_px,
                                    const Eigen::Matrix2d& px_from_texel,
                                    int max_taps) const {
  double a = px_from_texel.col(0).norm();
  double b = px_from_texel.col(1).norm();
  // A level where both sides need at most max_taps taps; a long thin footprint keeps the level of
  // its short side as far as four times max_taps allow.
  const double longest = std::max(a, b);
  const double shortest = std::max(std::min(a, b), longest / 4);
  int level = 0;
  double scale = 1;
  while (level + 1 < static_cast<int>(levels_.size()) && shortest * scale > max_taps) {
    ++level;
    scale /= 2;
  }
  a *= scale;
  b *= scale;
  const int num_a = std::clamp(static_cast<int>(std::ceil(a - 0.25)), 1, 4 * max_taps);
  const int num_b = std::clamp(static_cast<int>(std::ceil(b - 0.25)), 1, 4 * max_taps);
  const Image8& pixels = levels_[level];
  if (num_a * num_b == 1) return Bicubic(pixels, image_px.x() * scale, image_px.y() * scale);
  const bool few = num_a * num_b <= 4;
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (int j = 0; j < num_b; ++j) {
    for (int i = 0; i < num_a; ++i) {
      const Eigen::Vector2d in_texel((i + 0.5) / num_a - 0.5, (j + 0.5) / num_b - 0.5);
      const Eigen::Vector2d at = scale * (image_px + px_from_texel * in_texel);
      sum += few ? Bicubic(pixels, at.x(), at.y()) : Bilinear(pixels, at.x(), at.y());
    }
  }
  return sum / static_cast<float>(num_a * num_b);
}

}  // namespace groundglass
