// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/camera_model.h"

#include <cmath>
#include <limits>

namespace groundglass {
namespace {

// d/dr of r s(r^2), without the tangential terms.
double RadialSlope(const Distortion<double>& lens, double r2) {
  return 1 + 3 * lens.k1 * r2 + 5 * lens.k2 * r2 * r2 + 7 * lens.k3 * r2 * r2 * r2;
}

// Where between 0 and r2 the radial slope has its extremes; NaN for none.
struct Extremes {
  double r2[2];
};
Extremes FindExtremes(const Distortion<double>& lens) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double a = 21 * lens.k3;
  const double b = 10 * lens.k2;
  const double c = 3 * lens.k1;
  if (a == 0) return {{b == 0 ? kNone : -c / b, kNone}};
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return {{kNone, kNone}};
  const double q = -(b + std::copysign(std::sqrt(discriminant), b)) / 2;
  return {{q / a, q == 0 ? kNone : c / q}};
}

// Whether the distorted radius grows all the way from the centre to here. `tilt` is what the
// tangential terms add to its slope for each unit of radius.
bool GrowsUpTo(const Distortion<double>& lens, double r2, double tilt) {
  if (!(RadialSlope(lens, r2) + tilt * std::sqrt(r2) > 0)) return false;
  if (lens.k1 >= 0 && lens.k2 >= 0 && lens.k3 >= 0) return true;
  for (const double extreme : FindExtremes(lens).r2) {
    if (extreme > 0 && extreme < r2 &&
        !(RadialSlope(lens, extreme) + tilt * std::sqrt(extreme) > 0)) {
      return false;
    }
  }
  return true;
}

bool HasTangential(const Distortion<double>& lens) { return lens.p1 != 0 || lens.p2 != 0; }

// The inverse without the tangential terms: Newton's method between bounds that close in.
double UndistortRadius(const Distortion<double>& lens, double distorted_radius) {
  double low = 0;
  double high = std::numeric_limits<double>::infinity();
  double r = distorted_radius;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double r2 = r * r;
    double next = std::numeric_limits<double>::quiet_NaN();
    if (GrowsUpTo(lens, r2, 0)) {
      const double s = 1 + lens.k1 * r2 + lens.k2 * r2 * r2 + lens.k3 * r2 * r2 * r2;
      const double step = (r * s - distorted_radius) / RadialSlope(lens, r2);
      (step > 0 ? high : low) = r;
      next = r - step;
      if (std::abs(step) < 1e-15 * (1 + r)) return next;
    } else {
      high = r;
    }
    // A step out of the bounds, or from beyond the fold: halve them.
    r = next > low && next < high ? next : (low + std::min(high, 2 * low + 1e3)) / 2;
  }
  return GrowsUpTo(lens, r * r, 0) ? r : low;
}

}  // namespace

bool IsBeforeFold(const Distortion<double>& lens, const Eigen::Vector2d& point) {
  const double r2 = point.squaredNorm();
  if (!HasTangential(lens)) return GrowsUpTo(lens, r2, 0);
  // The slope along the ray from the centre gains 6 (p2 x + p1 y).
  const double r = std::sqrt(r2);
  const double tilt = r > 0 ? 6 * (lens.p2 * point.x() + lens.p1 * point.y()) / r : 0;
  if (!GrowsUpTo(lens, r2, tilt)) return false;
  const Eigen::Matrix2d derivative = DistortionDerivative<double>(lens, point);
  return derivative.trace() > 0 && derivative.determinant() > 0;
}

Eigen::Vector2d Undistort(const Distortion<double>& lens, const Eigen::Vector2d& distorted) {
  Eigen::Vector2d point = distorted;
  const double distorted_radius = distorted.norm();
  if (!(distorted_radius > 0) || IsNone(lens)) return point;
  point *= UndistortRadius(lens, distorted_radius) / distorted_radius;
  if (!HasTangential(lens)) return point;

  // From the radial solution on in the plane, never over the fold and never to a worse place.
  for (int i = 0; i < 100 && !IsBeforeFold(lens, point); ++i) point *= 0.9;
  Eigen::Vector2d error = Distort<double>(lens, point) - distorted;
  for (int iteration = 0; iteration < 12; ++iteration) {
    Eigen::Vector2d step = DistortionDerivative<double>(lens, point).inverse() * error;
    if (step.norm() < 1e-15 * (1 + point.norm())) break;
    bool is_better = false;
    for (int halving = 0; halving < 8 && !is_better; ++halving, step /= 2) {
      const Eigen::Vector2d trial = point - step;
      if (!IsBeforeFold(lens, trial)) continue;
      const Eigen::Vector2d trial_error = Distort<double>(lens, trial) - distorted;
      if (!(trial_error.squaredNorm() < error.squaredNorm())) continue;
      is_better = true;
      point = trial;
      error = trial_error;
    }
    if (!is_better) break;
  }
  return point;
}

}  // namespace groundglass
