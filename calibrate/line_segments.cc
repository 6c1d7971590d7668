// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/line_segments.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// How far from LSD's line the steepest gradient is looked for, and how far from the fitted line a
// place may lie and still count; pixels.
constexpr double kSearch_px = 2.5;
constexpr double kOutlier_px = 1.0;
// Places along a line that must be found for it to be fitted again.
constexpr double kLeastShare = 0.6;

double GreyAt(const Image8& grey, const Eigen::Vector2d& image_px) {
  const double x = image_px.x() - 0.5;
  const double y = image_px.y() - 0.5;
  const int left = static_cast<int>(std::floor(x));
  const int top = static_cast<int>(std::floor(y));
  if (left < 0 || top < 0 || left + 1 >= grey.width || top + 1 >= grey.height) return -1;
  const double u = x - left;
  const double v = y - top;
  return (1 - v) * ((1 - u) * *grey.At(left, top) + u * *grey.At(left + 1, top)) +
         v * ((1 - u) * *grey.At(left, top + 1) + u * *grey.At(left + 1, top + 1));
}

// Where the grey changes fastest across the line near one of its points: the offset along the
// normal, by the centre of gravity of the squared gradient about its peak. NaN at the picture's rim
// and where there is no edge.
double FindEdgeOffset(const Image8& grey,
                      const Eigen::Vector2d& at,
                      const Eigen::Vector2d& normal) {
  constexpr double kStep_px = 0.5;
  constexpr int kSteps = static_cast<int>(kSearch_px / kStep_px);
  double slopes[2 * kSteps + 1];
  int steepest = 0;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const double before = GreyAt(grey, at + (i * kStep_px - 0.5) * normal);
    const double behind = GreyAt(grey, at + (i * kStep_px + 0.5) * normal);
    if (before < 0 || behind < 0) return NAN;
    slopes[i + kSteps] = (behind - before) * (behind - before);
    if (slopes[i + kSteps] > slopes[steepest + kSteps]) steepest = i;
  }
  if (slopes[steepest + kSteps] < 4) return NAN;
  double weight = 0;
  double sum = 0;
  for (int i = std::max(-kSteps, steepest - 3); i <= std::min(kSteps, steepest + 3); ++i) {
    weight += slopes[i + kSteps];
    sum += slopes[i + kSteps] * i * kStep_px;
  }
  return sum / weight;
}

// The straight line through offsets along a segment (least squares, outliers left out): its offset
// in the middle and its slope. False if too few places agree.
bool FitOffsets(const std::vector<Eigen::Vector2d>& places, double& middle, double& slope) {
  middle = 0;
  slope = 0;
  size_t used = 0;
  for (int round = 0; round < 3; ++round) {
    double n = 0, s = 0, ss = 0, o = 0, so = 0;
    used = 0;
    for (const Eigen::Vector2d& place : places) {
      const double residual = place.y() - middle - slope * place.x();
      if (std::abs(residual) > (round == 0 ? kSearch_px : kOutlier_px)) continue;
      n += 1;
      s += place.x();
      ss += place.x() * place.x();
      o += place.y();
      so += place.x() * place.y();
      ++used;
    }
    const double determinant = n * ss - s * s;
    if (used < 4 || determinant <= 0) return false;
    slope = (n * so - s * o) / determinant;
    middle = (o - slope * s) / n;
  }
  return static_cast<double>(used) >= kLeastShare * static_cast<double>(places.size());
}

bool Refine(const Image8& grey, LineSegment& segment) {
  const Eigen::Vector2d along = segment.Direction();
  const Eigen::Vector2d normal(-along.y(), along.x());
  const double half = segment.Length() / 2;
  std::vector<Eigen::Vector2d> places;
  int asked = 0;
  for (double s = -half + 1; s <= half - 1; s += 1, ++asked) {
    const double offset = FindEdgeOffset(grey, segment.Middle() + s * along, normal);
    if (std::isfinite(offset)) places.emplace_back(s, offset);
  }
  double middle = 0;
  double slope = 0;
  if (static_cast<double>(places.size()) < kLeastShare * asked ||
      !FitOffsets(places, middle, slope)) {
    return false;
  }
  const Eigen::Vector2d center = segment.Middle() + middle * normal;
  const Eigen::Vector2d direction = (along + slope * normal).normalized();
  segment.begin_px = center - half * direction;
  segment.end_px = center + half * direction;
  return true;
}

}  // namespace

std::vector<LineSegment> FindLineSegments(const Image8& srgb_grey, double shortest_px) {
  const cv::Mat grey(
      srgb_grey.height, srgb_grey.width, CV_8UC1, const_cast<uint8_t*>(srgb_grey.values.data()));
  std::vector<cv::Vec4f> found;
  cv::createLineSegmentDetector(cv::LSD_REFINE_STD)->detect(grey, found);
  std::vector<LineSegment> segments;
  for (const cv::Vec4f& line : found) {
    // OpenCV's pixels have their centres at whole numbers.
    LineSegment segment{{line[0] + 0.5, line[1] + 0.5}, {line[2] + 0.5, line[3] + 0.5}};
    if (segment.Length() < shortest_px || !Refine(srgb_grey, segment)) continue;
    segments.push_back(segment);
  }
  std::stable_sort(segments.begin(), segments.end(), [](const auto& a, const auto& b) {
    return a.Length() > b.Length();
  });
  return segments;
}

}  // namespace groundglass
