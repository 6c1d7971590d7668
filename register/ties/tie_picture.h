// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <optional>
#include <vector>

namespace groundglass {

// A photograph as patches are taken from it: at its own size, half of it, and so on, light
// averaged, so that a patch whose texels span many pixels does not alias.
class TiePicture {
 public:
  TiePicture() = default;
  // grey8: 1 channel, sRGB codes. ignore: same size, non-zero where the photograph is no evidence;
  // may be empty.
  TiePicture(const Image8& grey8, const Image8& ignore, int num_levels);

  bool Empty() const { return levels_.empty(); }
  int width() const { return levels_.empty() ? 0 : levels_.front().width; }
  int height() const { return levels_.empty() ? 0 : levels_.front().height; }
  // As they were given; not of an empty one.
  const Image8& grey8() const { return levels_.front(); }
  const Image8& ignore() const { return ignore_; }
  // The light at a place of the photograph (pixels of its own size), bilinear, from the level whose
  // pixels are nearest to px_per_texel wide. Nothing beyond the frame or where it is no evidence.
  std::optional<float> LightAt(const Eigen::Vector2d& image_px, double px_per_texel) const;

 private:
  std::vector<Image8> levels_;
  Image8 ignore_;
};

}  // namespace groundglass
