// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// A photograph and its halvings, kept as 8-bit sRGB, filtered in linear light.
class PhotoPyramid {
 public:
  explicit PhotoPyramid(Image8 srgb8);

  // The mean radiance of the parallelogram centred at image_px and spanned by the columns of
  // px_from_texel: one texel's footprint. Taps are bicubic (Catmull-Rom; Keys 1981, a = -1/2), no
  // more than max_taps along each side; coarser levels serve larger footprints.
  Eigen::Array3f Sample(const Eigen::Vector2d& image_px,
                        const Eigen::Matrix2d& px_from_texel,
                        int max_taps = 4) const;

  const Image8& Full() const { return levels_.front(); }
  size_t NumBytes() const;

 private:
  Eigen::Array3f Bicubic(const Image8& level, double x, double y) const;
  Eigen::Array3f Bilinear(const Image8& level, double x, double y) const;

  std::vector<Image8> levels_;
};

// Radiance to 8-bit sRGB, rounded; values are clamped to [0, 1].
uint8_t Srgb8FromRadiance(float radiance);
// 8-bit sRGB to radiance.
float RadianceFromSrgb8(uint8_t srgb8);

}  // namespace groundglass
