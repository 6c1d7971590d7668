// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/digitizer.h"

#include "datasets-synthetic/noise.h"
#include "scene/frames.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

// The inverse of SlideTransform::ScanFromIdeal.
Eigen::Vector2d IdealFromScan(const SlideTransform& slide,
                              const Eigen::Vector2d& scan_px,
                              int width_px,
                              int height_px) {
  const Eigen::Vector2d center(width_px / 2.0, height_px / 2.0);
  const Eigen::Vector2d turned(
      (scan_px.x() - center.x() - slide.shift_x_px) / (slide.scale * (1 + slide.anisotropy / 2)),
      (scan_px.y() - center.y() - slide.shift_y_px) / (slide.scale * (1 - slide.anisotropy / 2)));
  const double turn = RadiansFromDegrees(slide.turn_deg);
  return center + Eigen::Vector2d(std::cos(turn) * turned.x() + std::sin(turn) * turned.y(),
                                  -std::sin(turn) * turned.x() + std::cos(turn) * turned.y());
}

}  // namespace

double DepthInOpening(const MountOpening& opening,
                      const SlideTransform& slide,
                      const Eigen::Vector2d& scan_px,
                      int width_px,
                      int height_px) {
  const Eigen::Vector2d ideal = IdealFromScan(slide, scan_px, width_px, height_px);
  const double radius = 0.012 * width_px;
  // Distance to a rectangle with rounded corners, measured from the core that the corners' centres
  // span.
  const Eigen::Vector2d half(width_px / 2.0 + opening.margin_px,
                             height_px / 2.0 + opening.margin_px);
  const Eigen::Vector2d from_center =
      (ideal - Eigen::Vector2d(width_px / 2.0, height_px / 2.0)).cwiseAbs();
  const Eigen::Vector2d beyond = from_center - (half - Eigen::Vector2d::Constant(radius));
  return radius - beyond.cwiseMax(0).norm() - std::min(0.0, beyond.maxCoeff());
}

void DrawMount(const MountOpening& opening, const SlideTransform& slide, ImageF& scan) {
  for (int y = 0; y < scan.height; ++y) {
    for (int x = 0; x < scan.width; ++x) {
      const double depth =
          DepthInOpening(opening, slide, {x + 0.5, y + 0.5}, scan.width, scan.height);
      if (depth > 2) continue;
      const double light = std::clamp((depth + 1.2) / 2.4, 0.0, 1.0);
      for (int c = 0; c < 3; ++c) {
        constexpr double kBlack = 7.0 / 255;
        float& value = scan.At(x, y)[c];
        value = static_cast<float>(kBlack + light * (value - kBlack));
      }
    }
  }
}

void DrawDust(int num_specks, int num_scratches, uint64_t seed, ImageF& scan) {
  cv::Mat layer(scan.height, scan.width, CV_32F, cv::Scalar(0));
  const auto draw = [&](int thing, int part, double low, double high) {
    return low + (high - low) * UniformOf(HashOf(seed, thing, part));
  };
  const double unit = scan.width / 1500.0;
  constexpr int kFixedPoint = 4;  // bits after the point in OpenCV's drawing
  const auto fixed = [&](double value) {
    return static_cast<int>(std::lround(value * (1 << kFixedPoint)));
  };
  const auto draw_hair = [&](int thing, double length, double bend, double value) {
    std::vector<cv::Point> points;
    double x = draw(thing, 0, 0, scan.width);
    double y = draw(thing, 1, 0, scan.height);
    double heading = draw(thing, 2, 0, 2 * std::numbers::pi);
    for (int step = 0; step < 12; ++step) {
      points.emplace_back(fixed(x), fixed(y));
      heading += bend * draw(thing, 10 + step, -1, 1);
      x += length / 12 * std::cos(heading);
      y += length / 12 * std::sin(heading);
    }
    cv::polylines(layer, points, false, cv::Scalar(value), 1, cv::LINE_8, kFixedPoint);
  };
  for (int i = 0; i < num_specks; ++i) {
    if (draw(i, 9, 0, 1) < 0.2) {
      draw_hair(i, unit * draw(i, 3, 15, 60), 0.5, -0.7);
    } else {
      cv::circle(layer,
                 {fixed(draw(i, 0, 0, scan.width)), fixed(draw(i, 1, 0, scan.height))},
                 fixed(unit * draw(i, 3, 0.6, 2)),
                 cv::Scalar(-draw(i, 4, 0.4, 0.9)),
                 cv::FILLED,
                 cv::LINE_8,
                 kFixedPoint);
    }
  }
  for (int i = 0; i < num_scratches; ++i) {
    draw_hair(1000 + i, unit * draw(1000 + i, 3, 80, 400), 0.03, 0.35);
  }
  cv::GaussianBlur(layer, layer, {3, 3}, 0.6, 0.6);
  for (int y = 0; y < scan.height; ++y) {
    for (int x = 0; x < scan.width; ++x) {
      const float strength = layer.at<float>(y, x);
      if (strength == 0) continue;
      for (int c = 0; c < 3; ++c) {
        float& value = scan.At(x, y)[c];
        const float toward = strength < 0 ? 0.08f : 1.0f;
        value += std::abs(strength) * (toward - value);
      }
    }
  }
}

ImageF NtscFromScan(const ImageF& scan, uint64_t seed) {
  constexpr int kWidth = 640;
  constexpr int kHeight = 480;
  const cv::Mat source(scan.height, scan.width, CV_32FC3, const_cast<float*>(scan.values.data()));
  cv::Mat frame;
  cv::resize(source, frame, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
  // The second field is sampled a little aside: the recorder's time base.
  constexpr double kFieldShift = 0.35;  // px
  cv::Mat shifted;
  const cv::Matx23d aside(1, 0, kFieldShift, 0, 1, 0);
  cv::warpAffine(frame, shifted, aside, frame.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  for (int y = 1; y < kHeight; y += 2) shifted.row(y).copyTo(frame.row(y));
  // Rec. 601: luma of 4.2 MHz, I of 1.3 and Q of 0.5; 640 px last 52.6 us of a line.
  const cv::Matx33f yiq_from_rgb(
      0.299f, 0.587f, 0.114f, 0.596f, -0.274f, -0.322f, 0.211f, -0.523f, 0.312f);
  cv::Mat yiq;
  cv::transform(frame, yiq, yiq_from_rgb);
  std::vector<cv::Mat> planes;
  cv::split(yiq, planes);
  const double bandwidth_mhz[3] = {4.2, 1.3, 0.5};
  const double noise[3] = {0.012, 0.02, 0.02};
  for (int plane = 0; plane < 3; ++plane) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        planes[plane].at<float>(y, x) +=
            static_cast<float>(noise[plane] * NormalOf(HashOf(seed, x, y, plane)));
      }
    }
    // A Gaussian whose response falls to a half at the bandwidth.
    const double cycles_per_px = bandwidth_mhz[plane] * 52.6 / kWidth;
    const double sigma = std::sqrt(std::log(2.0) / 2) / (std::numbers::pi * cycles_per_px);
    cv::GaussianBlur(planes[plane], planes[plane], {0, 1}, sigma, 0.01, cv::BORDER_REPLICATE);
  }
  cv::merge(planes, yiq);
  cv::Mat rgb;
  cv::transform(yiq, rgb, yiq_from_rgb.inv());
  ImageF result(kWidth, kHeight, 3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int c = 0; c < 3; ++c) {
        result.At(x, y)[c] = std::clamp(rgb.at<cv::Vec3f>(y, x)[c], 0.0f, 1.0f);
      }
    }
  }
  return result;
}

}  // namespace groundglass
