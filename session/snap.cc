// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/snap.h"

#include "scene/check_option.h"
#include "scene/srgb.h"
#include "scene/symmetric_eigen.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

double GreyAt(const Image8& picture, int x, int y) {
  const uint8_t* pixel =
      picture.At(std::clamp(x, 0, picture.width - 1), std::clamp(y, 0, picture.height - 1));
  if (picture.channels < 3) return pixel[0];
  return Luma(pixel[0], pixel[1], pixel[2]);
}

// Grey levels a pixel, over three rows or columns, which evens out grain.
Eigen::Vector2d GradientAt(const Image8& picture, int x, int y) {
  const auto grey = [&](int by_x, int by_y) { return GreyAt(picture, x + by_x, y + by_y); };
  const double across =
      grey(1, -1) - grey(-1, -1) + 2 * (grey(1, 0) - grey(-1, 0)) + grey(1, 1) - grey(-1, 1);
  const double down =
      grey(-1, 1) - grey(-1, -1) + 2 * (grey(0, 1) - grey(0, -1)) + grey(1, 1) - grey(1, -1);
  return Eigen::Vector2d(across, down) / 8;
}

// Sums of w g g^T, and of w g g^T (p - at), over the pixels p near a place.
struct GradientSums {
  double weight = 0;
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  Eigen::Vector2d pull = Eigen::Vector2d::Zero();
};

GradientSums SumAround(const Image8& picture, const Eigen::Vector2d& at, double window_px) {
  GradientSums sums;
  const auto first = [&](double middle) {
    return static_cast<int>(std::floor(middle - window_px));
  };
  const auto last = [&](double middle) { return static_cast<int>(std::floor(middle + window_px)); };
  for (int y = first(at.y()); y <= last(at.y()); ++y) {
    for (int x = first(at.x()); x <= last(at.x()); ++x) {
      const Eigen::Vector2d by = Eigen::Vector2d(x + 0.5, y + 0.5) - at;
      const double in_widths = by.norm() / (0.5 * window_px);
      const double weight = std::exp(-0.5 * in_widths * in_widths);
      const Eigen::Vector2d gradient = GradientAt(picture, x, y);
      const Eigen::Matrix2d square = weight * gradient * gradient.transpose();
      sums.weight += weight;
      sums.squares += square;
      sums.pull += square * by;
    }
  }
  return sums;
}

}  // namespace

void SnapOptions::Check() const {
  CheckAbove(reach_px, 0, "snap options: reach_px");
  CheckFromTo(window_px, 1, 100, "snap options: window_px");
  CheckFromTo(corner_share, 0, 1, "snap options: corner_share");
  CheckAbove(least_contrast, 0, "snap options: least_contrast");
}

std::optional<Eigen::Vector2d> SnapToPicture(const Image8& srgb8,
                                             const Eigen::Vector2d& image_px,
                                             const SnapOptions& options) {
  options.Check();
  if (srgb8.Empty() || !image_px.allFinite()) return std::nullopt;
  Eigen::Vector2d at = image_px;
  constexpr int kMostSteps = 30;
  constexpr double kStillPx = 1e-3;
  for (int step = 0; step < kMostSteps; ++step) {
    const GradientSums sums = SumAround(srgb8, at, options.window_px);
    const SymmetricEigen axes = DecomposeSymmetric(sums.squares);
    const double strong = axes.values[1];
    const double weak = axes.values[0];
    if (!(strong > sums.weight * options.least_contrast * options.least_contrast)) {
      return std::nullopt;
    }
    const Eigen::Vector2d across = axes.vectors.col(1);
    const bool is_corner = weak > options.corner_share * strong;
    const Eigen::Vector2d by = is_corner ? Eigen::Vector2d(sums.squares.inverse() * sums.pull)
                                         : across * (across.dot(sums.pull) / strong);
    at += by;
    if (!((at - image_px).norm() <= options.reach_px)) return std::nullopt;
    if (by.norm() < kStillPx) break;
  }
  return at;
}

}  // namespace groundglass
