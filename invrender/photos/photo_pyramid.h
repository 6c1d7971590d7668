// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <span>
#include <vector>

namespace groundglass {

// A photograph and its halvings, kept as sRGB of 8 or 16 bits, filtered in linear light.
class PhotoPyramid {
 public:
  explicit PhotoPyramid(Image8 srgb8);
  explicit PhotoPyramid(Image16 srgb16);

  // Forgets that many of the finest levels, where only coarser ones are needed; one is always kept.
  // What is sampled is still given in the whole photograph's pixels.
  void DropLevels(int num_dropped);

  // The mean radiance of the parallelogram centred at image_px and spanned by the columns of
  // px_from_texel: one texel's footprint. Taps are bicubic (Catmull-Rom; Keys 1981, a = -1/2), no
  // more than max_taps along each side; coarser levels serve larger footprints.
  Eigen::Array3f Sample(const Eigen::Vector2d& image_px,
                        const Eigen::Matrix2d& px_from_texel,
                        int max_taps = 4) const;

  int bits() const { return levels16_.empty() ? 8 : 16; }
  // The finest level that is kept.
  const Image8& Full() const { return levels8_.front(); }      // if bits() is 8
  const Image16& Full16() const { return levels16_.front(); }  // if bits() is 16
  size_t NumBytes() const;

 private:
  // One of them is empty.
  std::vector<Image8> levels8_;
  std::vector<Image16> levels16_;
  int num_dropped_ = 0;
};

// Radiance to 8-bit sRGB, rounded; values are clamped to [0, 1].
uint8_t Srgb8FromRadiance(float radiance);
void Srgb8FromRadiance(std::span<const float> radiance, uint8_t* srgb8);
uint16_t Srgb16FromRadiance(float radiance);
// 8-bit sRGB to radiance.
float RadianceFromSrgb8(uint8_t srgb8);

}  // namespace groundglass
