// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/compose/fill.h"

#include "scene/textured_model.h"

#include <opencv2/core.hpp>
#include <opencv2/photo.hpp>

namespace groundglass {
namespace {

// All that is unknown (not 0), in place.
void PaintOver(const cv::Mat& unknown, double radius, ChartPixels& pixels) {
  cv::Mat painted;
  if (pixels.srgb16.Empty()) {
    cv::Mat srgb8(unknown.rows, unknown.cols, CV_8UC3, pixels.srgb8.values.data());
    cv::inpaint(srgb8, unknown, painted, radius, cv::INPAINT_TELEA);
    painted.copyTo(srgb8, unknown);
    return;
  }
  // With 16 bits OpenCV does one channel at a time.
  cv::Mat srgb16(unknown.rows, unknown.cols, CV_16UC3, pixels.srgb16.values.data());
  for (int channel = 0; channel < 3; ++channel) {
    cv::Mat plane;
    cv::extractChannel(srgb16, plane, channel);
    cv::inpaint(plane, unknown, painted, radius, cv::INPAINT_TELEA);
    painted.copyTo(plane, unknown);
    cv::insertChannel(plane, srgb16, channel);
  }
}

}  // namespace

void FillOpenTexels(const FillOptions& options, ChartPixels& pixels) {
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
  PaintOver(unknown, options.radius_texels, pixels);
  for (size_t i = 0; i < pixels.states.values.size(); ++i) {
    if (!is_state(i, TexelState::kOpen)) continue;
    pixels.provenance.values[i] = kProvenanceFilled;
    pixels.states.values[i] = static_cast<uint8_t>(TexelState::kWeak);
  }
}

}  // namespace groundglass
