// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/line_drawing.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontCapHeightPx = 21;  // of OpenCV's Hershey font at scale 1

int TextThickness(double cap_height_px) {
  return std::max(1, static_cast<int>(std::lround(cap_height_px / 9)));
}

}  // namespace

void AddLine(CoverageMask& coverage,
             const Eigen::Vector2d& start_px,
             const Eigen::Vector2d& end_px,
             double width_px) {
  const double reach = width_px / 2 + 0.5;
  const Eigen::Vector2d along = end_px - start_px;
  const double length2 = along.squaredNorm();
  const int first_row = static_cast<int>(
      std::clamp(std::floor(std::min(start_px.y(), end_px.y()) - reach), 0.0, 1e9));
  const int last_row = static_cast<int>(std::clamp(
      std::ceil(std::max(start_px.y(), end_px.y()) + reach), -1.0, coverage.height - 1.0));
  for (int y = first_row; y <= last_row; ++y) {
    // Only the part of the line within reach of this row can touch it.
    double from = 0;
    double to = 1;
    if (along.y() != 0) {
      const double t0 = (y + 0.5 - reach - start_px.y()) / along.y();
      const double t1 = (y + 0.5 + reach - start_px.y()) / along.y();
      from = std::clamp(std::min(t0, t1), 0.0, 1.0);
      to = std::clamp(std::max(t0, t1), 0.0, 1.0);
    }
    const double x0 = start_px.x() + from * along.x();
    const double x1 = start_px.x() + to * along.x();
    const int first = static_cast<int>(std::clamp(std::floor(std::min(x0, x1) - reach), 0.0, 1e9));
    const int last = static_cast<int>(
        std::clamp(std::ceil(std::max(x0, x1) + reach), -1.0, coverage.width - 1.0));
    for (int x = first; x <= last; ++x) {
      const Eigen::Vector2d from_start = Eigen::Vector2d(x + 0.5, y + 0.5) - start_px;
      const double t = length2 > 0 ? std::clamp(from_start.dot(along) / length2, 0.0, 1.0) : 0.0;
      const double distance = (from_start - t * along).norm();
      const float share =
          static_cast<float>(std::clamp(reach - distance, 0.0, std::min(1.0, width_px)));
      float& pixel = *coverage.At(x, y);
      pixel = std::max(pixel, share);
    }
  }
}

void LayOver(Image8& srgb8, const CoverageMask& coverage, Srgb8Colour colour, double opacity) {
  for (size_t i = 0; i < coverage.values.size(); ++i) {
    const float share = coverage.values[i] * static_cast<float>(opacity);
    if (share <= 0) continue;
    uint8_t* pixel = &srgb8.values[static_cast<size_t>(srgb8.channels) * i];
    float colour_share = share;
    if (srgb8.channels == 4) {
      const float alpha = share + (1 - share) * pixel[3] / 255.0f;
      colour_share = share / alpha;
      pixel[3] = static_cast<uint8_t>(std::lround(255 * alpha));
    }
    for (int channel = 0; channel < 3; ++channel) {
      const float below = pixel[channel];
      pixel[channel] =
          static_cast<uint8_t>(std::lround(below + colour_share * (colour[channel] - below)));
    }
  }
}

void DrawText(Image8& srgb8,
              const std::string& text,
              const Eigen::Vector2d& baseline_px,
              double cap_height_px,
              Srgb8Colour colour) {
  cv::Mat view(srgb8.height, srgb8.width, CV_8UC3, srgb8.values.data());
  cv::putText(view,
              text,
              cv::Point(static_cast<int>(std::lround(baseline_px.x() - 0.5)),
                        static_cast<int>(std::lround(baseline_px.y() - 0.5))),
              kFont,
              cap_height_px / kFontCapHeightPx,
              cv::Scalar(colour[0], colour[1], colour[2]),
              TextThickness(cap_height_px),
              cv::LINE_AA);
}

double TextWidth(const std::string& text, double cap_height_px) {
  int baseline = 0;
  return cv::getTextSize(
             text, kFont, cap_height_px / kFontCapHeightPx, TextThickness(cap_height_px), &baseline)
      .width;
}

}  // namespace groundglass
