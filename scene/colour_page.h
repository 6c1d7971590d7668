// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/srgb.h"
#include "scene/textured_model.h"

#include <array>
#include <vector>

namespace groundglass {

// Plain colours as a texture page: side by side, a texel each. All corners of a face lie in the
// middle of its texel, where nothing of the others is mixed in.
class ColourPage {
 public:
  bool IsEmpty() const { return colours_.empty(); }

  // Lays a face of so many corners on it; linear: red, green and blue, linear light. page: the
  // number that the page will have.
  FaceTexture Add(const std::array<float, 3>& linear, int page, size_t num_corners) {
    const size_t column = colours_.size() % kWidth;
    const size_t row = colours_.size() / kWidth;
    const Eigen::Vector2d centre(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    colours_.push_back(linear);
    return {page, std::vector<Eigen::Vector2d>(num_corners, centre)};
  }

  // sRGB; what does not fit into 0 to 1 is cut.
  TexturePage Page() const {
    Image8 srgb8(kWidth, static_cast<int>(colours_.size() / kWidth) + 1, 3);
    for (size_t i = 0; i < colours_.size(); ++i) {
      for (size_t c = 0; c < 3; ++c) srgb8.values[3 * i + c] = Srgb8FromLinear(colours_[i][c]);
    }
    return {std::move(srgb8), {}};
  }

 private:
  static constexpr size_t kWidth = 256;
  std::vector<std::array<float, 3>> colours_;
};

}  // namespace groundglass
