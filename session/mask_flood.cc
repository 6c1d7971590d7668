// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/mask_flood.h"

#include "scene/check_option.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace groundglass {
namespace {

constexpr uint8_t kReached = 255;
constexpr uint8_t kTooFar = 1;  // in colour, from where it began

}  // namespace

void FloodOptions::Check() const {
  CheckFromTo(step, 0, 255, "flood options: step");
  CheckFromTo(range, 0, 255, "flood options: range");
}

Image8 FindFlood(const Image8& srgb8, const Eigen::Vector2d& from_px, const FloodOptions& options) {
  options.Check();
  const cv::Point start(static_cast<int>(std::floor(from_px.x())),
                        static_cast<int>(std::floor(from_px.y())));
  if (!cv::Rect(0, 0, srgb8.width, srgb8.height).contains(start)) return {};
  const cv::Mat picture(
      srgb8.height, srgb8.width, CV_8UC3, const_cast<uint8_t*>(srgb8.values.data()));
  cv::Mat even;
  cv::blur(picture, even, {3, 3}, {-1, -1}, cv::BORDER_REPLICATE);
  const cv::Vec3b start_colour = even.at<cv::Vec3b>(start);
  cv::Scalar darkest;
  cv::Scalar brightest;
  for (int c = 0; c < 3; ++c) {
    darkest[c] = std::max(0, start_colour[c] - options.range);
    brightest[c] = std::min(255, start_colour[c] + options.range);
  }
  // OpenCV floods a mask that is a pixel wider all around, and stops at what is set in it.
  cv::Mat mask = cv::Mat::zeros(srgb8.height + 2, srgb8.width + 2, CV_8UC1);
  cv::Mat inner = mask({1, 1, srgb8.width, srgb8.height});
  cv::Mat is_near;
  cv::inRange(even, darkest, brightest, is_near);
  inner.setTo(kTooFar, is_near == 0);
  const cv::Scalar step = cv::Scalar::all(options.step);
  cv::floodFill(
      even, mask, start, {}, nullptr, step, step, 4 | cv::FLOODFILL_MASK_ONLY | (kReached << 8));
  Image8 flood(srgb8.width, srgb8.height, 1);
  cv::Mat reached(srgb8.height, srgb8.width, CV_8UC1, flood.values.data());
  cv::compare(inner, kReached, reached, cv::CMP_EQ);
  return flood;
}

}  // namespace groundglass
