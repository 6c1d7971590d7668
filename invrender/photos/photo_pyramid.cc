// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/photos/photo_pyramid.h"

#include "invrender/photos/srgb_codes.h"
#include "scene/cubic_weights.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace groundglass {
namespace {

// The largest whole number that is no larger; without SSE 4.1 std::floor is a long way round.
inline int FloorToInt(double value) {
  const int truncated = static_cast<int>(value);
  return truncated - (value < truncated ? 1 : 0);
}

template <typename Code>
Raster<Code> Halve(const Raster<Code>& full) {
  Raster<Code> half(std::max(1, full.width / 2), std::max(1, full.height / 2), 3);
  const float* radiance = RadianceOfCodes<Code>();
  const Srgb8Encoder encode8;
  const auto encode = [&](float mean) {  // of codes, so from 0 to 1
    if constexpr (sizeof(Code) == 1) {
      return encode8.InRange(mean);
    } else {
      return Srgb16FromRadiance(mean);
    }
  };
  tbb::parallel_for(0, half.height, [&](int y) {
    const Code* top = full.At(0, 2 * y);
    const Code* bottom = full.At(0, std::min(2 * y + 1, full.height - 1));
    Code* to = half.At(0, y);
    for (int x = 0; x < half.width; ++x) {
      const int left = 6 * x;
      const int right = 3 * std::min(2 * x + 1, full.width - 1);
      for (int c = 0; c < 3; ++c) {
        const float sum = radiance[top[left + c]] + radiance[top[right + c]] +
                          radiance[bottom[left + c]] + radiance[bottom[right + c]];
        to[3 * x + c] = encode(sum / 4);
      }
    }
  });
  return half;
}

template <typename Code>
std::vector<Raster<Code>> MakeLevels(Raster<Code> full) {
  std::vector<Raster<Code>> levels;
  levels.push_back(std::move(full));
  while (std::min(levels.back().width, levels.back().height) >= 8) {
    levels.push_back(Halve(levels.back()));
  }
  return levels;
}

template <typename Code>
Eigen::Array3f Bicubic(const Raster<Code>& level, double x, double y) {
  const float* radiance = RadianceOfCodes<Code>();
  const int fx = FloorToInt(x - 0.5);
  const int fy = FloorToInt(y - 0.5);
  const std::array<float, 4> wx = CubicWeights(static_cast<float>(x - 0.5 - fx));
  const std::array<float, 4> wy = CubicWeights(static_cast<float>(y - 0.5 - fy));
  const int x0 = fx - 1;
  const int y0 = fy - 1;
  // Where the four columns start in a row, clamped at the frame.
  std::array<int, 4> columns;
  for (int i = 0; i < 4; ++i) columns[i] = 3 * std::clamp(x0 + i, 0, level.width - 1);
  const Code* rows[4];
  for (int j = 0; j < 4; ++j) rows[j] = level.At(0, std::clamp(y0 + j, 0, level.height - 1));
  std::array<float, 12> sums;
  for (int i = 0; i < 4; ++i) {
    for (int c = 0; c < 3; ++c) {
      const int at = columns[i] + c;
      float sum = wy[0] * radiance[rows[0][at]];
      sum += wy[1] * radiance[rows[1][at]];
      sum += wy[2] * radiance[rows[2][at]];
      sum += wy[3] * radiance[rows[3][at]];
      sums[3 * i + c] = sum * wx[i];
    }
  }
  std::array<float, 3> sum;
  for (int c = 0; c < 3; ++c) sum[c] = (sums[c] + sums[3 + c]) + (sums[6 + c] + sums[9 + c]);
  return {std::max(sum[0], 0.0f), std::max(sum[1], 0.0f), std::max(sum[2], 0.0f)};
}

template <typename Code>
Eigen::Array3f Bilinear(const Raster<Code>& level, double x, double y) {
  const float* radiance = RadianceOfCodes<Code>();
  const int fx = FloorToInt(x - 0.5);
  const int fy = FloorToInt(y - 0.5);
  const float tx = static_cast<float>(x - 0.5 - fx);
  const float ty = static_cast<float>(y - 0.5 - fy);
  const int x0 = std::clamp(fx, 0, level.width - 1);
  const int y0 = std::clamp(fy, 0, level.height - 1);
  const int x1 = std::clamp(fx + 1, 0, level.width - 1);
  const int y1 = std::clamp(fy + 1, 0, level.height - 1);
  const auto at = [&](int px, int py) {
    const Code* pixel = level.At(px, py);
    return Eigen::Array3f(radiance[pixel[0]], radiance[pixel[1]], radiance[pixel[2]]);
  };
  return (1 - ty) * ((1 - tx) * at(x0, y0) + tx * at(x1, y0)) +
         ty * ((1 - tx) * at(x0, y1) + tx * at(x1, y1));
}

template <typename Code>
Eigen::Array3f SampleLevels(const std::vector<Raster<Code>>& levels,
                            const Eigen::Vector2d& image_px,
                            const Eigen::Matrix2d& px_from_texel,
                            const SamplingOptions& options,
                            int num_dropped) {
  double a = px_from_texel.col(0).squaredNorm();
  double b = px_from_texel.col(1).squaredNorm();
  // One tap of the finest level will do, as for most texels.
  const double most = options.max_taps > 1 ? options.one_tap_px : 1;
  if (num_dropped == 0 && std::max(a, b) <= most * most) {
    return Bicubic(levels.front(), image_px.x(), image_px.y());
  }
  a = std::sqrt(a);
  b = std::sqrt(b);
  // A level where both sides need at most max_taps taps, but for long thin footprints.
  const double longest = std::max(a, b);
  const double shortest = std::max(std::min(a, b), longest / options.max_anisotropy);
  int level = 0;
  double scale = 1.0 / (1 << num_dropped);
  while (level + 1 < static_cast<int>(levels.size()) && shortest * scale > options.max_taps) {
    ++level;
    scale /= 2;
  }
  a *= scale;
  b *= scale;
  const auto num_taps = [&](double length) {
    const double most_taps = std::ceil(options.max_anisotropy * options.max_taps);
    return static_cast<int>(
        std::clamp(std::ceil(length - (options.one_tap_px - 1)), 1.0, most_taps));
  };
  const int num_a = num_taps(a);
  const int num_b = num_taps(b);
  const Raster<Code>& pixels = levels[level];
  if (num_a * num_b == 1) return Bicubic(pixels, image_px.x() * scale, image_px.y() * scale);
  const bool few = num_a * num_b <= options.bicubic_taps;
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

}  // namespace

PhotoPyramid::PhotoPyramid(Image8 srgb8) : levels8_(MakeLevels(std::move(srgb8))) {}
PhotoPyramid::PhotoPyramid(Image16 srgb16) : levels16_(MakeLevels(std::move(srgb16))) {}

void PhotoPyramid::DropLevels(int num_dropped) {
  const auto drop = [&](auto& levels) {
    for (; num_dropped > 0 && levels.size() > 1; --num_dropped, ++num_dropped_) {
      levels.erase(levels.begin());
    }
  };
  drop(levels8_);
  drop(levels16_);
}

size_t PhotoPyramid::NumBytes() const {
  size_t num_bytes = 0;
  for (const Image8& level : levels8_) num_bytes += level.values.size();
  for (const Image16& level : levels16_) num_bytes += 2 * level.values.size();
  return num_bytes;
}

Eigen::Array3f PhotoPyramid::Sample(const Eigen::Vector2d& image_px,
                                    const Eigen::Matrix2d& px_from_texel,
                                    const SamplingOptions& options) const {
  return levels16_.empty()
             ? SampleLevels(levels8_, image_px, px_from_texel, options, num_dropped_)
             : SampleLevels(levels16_, image_px, px_from_texel, options, num_dropped_);
}

}  // namespace groundglass
