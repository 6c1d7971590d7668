// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/sampling_options.h"
#include "scene/image.h"

#include <Eigen/Dense>

#include <cstddef>
#include <vector>

namespace groundglass {

// One tap, at the level where the footprint is a pixel.
inline constexpr SamplingOptions kOneTap = {.max_taps = 1};

// A photograph and its halvings (a mipmap), kept as sRGB of 8 or 16 bits, filtered in linear light.
// (cv::pyrDown filters codes; of light it would need floats, which take four times the memory.)
class PhotoPyramid {
 public:
  explicit PhotoPyramid(Image8 srgb8);
  explicit PhotoPyramid(Image16 srgb16);

  // Forgets that many of the finest levels, where only coarser ones are needed; one is always kept.
  // What is sampled is still given in the whole photograph's pixels.
  void DropLevels(int num_dropped);

  // The mean radiance of the parallelogram centred at image_px and spanned by the columns of
  // px_from_texel: one texel's footprint. Taps are bicubic (Catmull-Rom; Keys 1981, a = -1/2);
  // coarser levels serve larger footprints.
  Eigen::Array3f Sample(const Eigen::Vector2d& image_px,
                        const Eigen::Matrix2d& px_from_texel,
                        const SamplingOptions& options = {}) const;

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

}  // namespace groundglass
