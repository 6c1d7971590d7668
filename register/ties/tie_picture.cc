// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/tie_picture.h"

#include "scene/reduce.h"
#include "scene/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
TiePicture::TiePicture(const Image8& grey8, const Image8& ignore, int num_levels)
    : levels_{grey8}, ignore_(ignore) {
  while (static_cast<int>(levels_.size()) < num_levels) {
    const Image8& finer = levels_.back();
    if (finer.width < 2 || finer.height < 2) break;
    levels_.push_back(ReducedInLight(finer, finer.width / 2, finer.height / 2));
  }
}

std::optional<float> TiePicture::LightAt(const Eigen::Vector2d& image_px,
                                         double px_per_texel) const {
  const Image8& whole = levels_.front();
  const int column = static_cast<int>(std::floor(image_px.x()));
  const int row = static_cast<int>(std::floor(image_px.y()));
  if (column < 0 || row < 0 || column >= whole.width || row >= whole.height) return std::nullopt;
  if (!ignore_.Empty() && *ignore_.At(column, row)) return std::nullopt;
  const auto number = static_cast<size_t>(
      std::clamp(static_cast<int>(std::lround(std::log2(std::max(px_per_texel, 1.0)))),
                 0,
                 static_cast<int>(levels_.size()) - 1));
  const Image8& level = levels_[number];
  const double x = image_px.x() * level.width / whole.width - 0.5;
  const double y = image_px.y() * level.height / whole.height - 0.5;
  const int left = static_cast<int>(std::floor(x));
  const int top = static_cast<int>(std::floor(y));
  if (left < 0 || top < 0 || left + 1 >= level.width || top + 1 >= level.height) {
    return std::nullopt;
  }
  const std::array<float, 256>& light = LinearOfSrgb8();
  const auto across = static_cast<float>(x - left);
  const auto down = static_cast<float>(y - top);
  const uint8_t* upper = level.At(left, top);
  const uint8_t* lower = level.At(left, top + 1);
  return (1 - down) * ((1 - across) * light[upper[0]] + across * light[upper[1]]) +
         down * ((1 - across) * light[lower[0]] + across * light[lower[1]]);
}

}  // namespace groundglass
