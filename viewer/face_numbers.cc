// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/face_numbers.h"

#include "viewer/edge_drawing.h"
#include "viewer/line_drawing.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <map>
#include <string>

namespace groundglass {
namespace {

constexpr Srgb8Colour kInk = {20, 20, 26};
constexpr double kLeastCapHeightPx = 5;

// The widest place of a face in the picture: the centre of its largest inscribed disc.
struct WidestPlace {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double radius_px = 0;
};

std::map<int, WidestPlace> FindWidestPlaces(const Image16& labels) {
  cv::Mat inside(labels.height, labels.width, CV_8UC1);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      const uint16_t label = *labels.At(x, y);
      const bool is_frame = x == 0 || y == 0 || x + 1 == labels.width || y + 1 == labels.height;
      const bool is_border = is_frame || label != *labels.At(x - 1, y) ||
                             label != *labels.At(x, y - 1) || label != *labels.At(x + 1, y) ||
                             label != *labels.At(x, y + 1);
      inside.at<uint8_t>(y, x) = label != 0 && !is_border ? 255 : 0;
    }
  }
  cv::Mat distance;
  cv::distanceTransform(inside, distance, cv::DIST_L2, cv::DIST_MASK_5);
  std::map<int, WidestPlace> places;
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      const float radius = distance.at<float>(y, x);
      if (radius <= 0) continue;
      WidestPlace& place = places[*labels.At(x, y)];
      if (radius > place.radius_px) place = {{x + 0.5, y + 0.5}, radius};
    }
  }
  return places;
}

}  // namespace

void DrawFaceNumbers(Image8& srgb8, const Image16& labels) {
  const double largest_cap_px = 14 * LineUnit(srgb8);
  for (const auto& [number, place] : FindWidestPlaces(labels)) {
    const std::string text = std::to_string(number);
    // The text's box has its corners inside the disc.
    const double diagonal_per_cap =
        std::hypot(TextWidth(text, largest_cap_px) / largest_cap_px, 1.0);
    const double cap_px = std::min(largest_cap_px, 2 * place.radius_px / diagonal_per_cap);
    if (cap_px < kLeastCapHeightPx) continue;
    DrawText(srgb8,
             text,
             place.center_px + Eigen::Vector2d(-TextWidth(text, cap_px) / 2, cap_px / 2),
             cap_px,
             kInk);
  }
}

}  // namespace groundglass
