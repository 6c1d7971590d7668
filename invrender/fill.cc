// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/fill.h"

#include <opencv2/core.hpp>
#include <opencv2/photo.hpp>

#include <algorithm>

namespace groundglass {

void FillOpenTexels(ChartPixels& pixels) {
  constexpr double kRadius = 4;  // texels that speak for one
  const auto is_state = [&](size_t i, TexelState state) {
    return static_cast<TexelState>(pixels.states.values[i]) == state;
  };
  const int width = pixels.states.width;
  const int height = pixels.states.height;
  // What lies outside of the faces is unknown too, and not to be learned from.
  cv::Mat unknown(height, width, CV_8U, cv::Scalar(0));
  size_t num_open = 0;
  size_t num_known = 0;
  for (size_t i = 0; i < pixels.states.values.size(); ++i) {
    const bool is_open = is_state(i, TexelState::kOpen);
    num_open += is_open ? 1 : 0;
    if (is_open || is_state(i, TexelState::kOutside)) {
      unknown.data[i] = 255;
    } else {
      ++num_known;
    }
  }
  if (num_open == 0 || num_known == 0) return;
  const cv::Mat srgb8(height, width, CV_8UC3, pixels.srgb8.values.data());
  cv::Mat painted;
  cv::inpaint(srgb8, unknown, painted, kRadius, cv::INPAINT_TELEA);
  for (size_t i = 0; i < pixels.states.values.size(); ++i) {
    if (!is_state(i, TexelState::kOpen)) continue;
    std::copy_n(painted.data + 3 * i, 3, &pixels.srgb8.values[3 * i]);
    pixels.provenance.values[i] = kProvenanceFilled;
    pixels.states.values[i] = static_cast<uint8_t>(TexelState::kWeak);
  }
}

}  // namespace groundglass
