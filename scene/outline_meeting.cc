// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/outline_loops.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace groundglass {
namespace {

// The side of the line a-b on which p lies: -1, 0 (on it, within `tolerance`), 1.
int SideOf(const Eigen::Vector2d& a,
           const Eigen::Vector2d& b,
           const Eigen::Vector2d& p,
           double tolerance) {
  const double distance = Cross2(b - a, p - a) / (b - a).norm();
  return distance > tolerance ? 1 : distance < -tolerance ? -1 : 0;
}

bool IsWithin(const Eigen::Vector2d& a,
              const Eigen::Vector2d& b,
              const Eigen::Vector2d& p,
              double tolerance) {
  const Eigen::Vector2d along = (b - a).normalized();
  const double t = along.dot(p - a);
  return t >= -tolerance && t <= (b - a).norm() + tolerance;
}

// True if the two closed segments have a point in common.
bool SegmentsMeet(const Eigen::Vector2d& a,
                  const Eigen::Vector2d& b,
                  const Eigen::Vector2d& c,
                  const Eigen::Vector2d& d,
                  double tolerance) {
  const int c_side = SideOf(a, b, c, tolerance);
  const int d_side = SideOf(a, b, d, tolerance);
  const int a_side = SideOf(c, d, a, tolerance);
  const int b_side = SideOf(c, d, b, tolerance);
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && IsWithin(a, b, c, tolerance)) ||
         (d_side == 0 && IsWithin(a, b, d, tolerance)) ||
         (a_side == 0 && IsWithin(c, d, a, tolerance)) ||
         (b_side == 0 && IsWithin(c, d, b, tolerance));
}

// Whether two sides have more in common than an end.
bool SidesMeet(const Outline& outline, const OutlineSide& first, const OutlineSide& second) {
  const int a = outline.weld[first.start];
  const int b = outline.weld[first.end];
  const int c = outline.weld[second.start];
  const int d = outline.weld[second.end];
  const bool shares_start = a == c || a == d;
  const bool shares_end = b == c || b == d;
  if (shares_start && shares_end) return true;
  if (!shares_start && !shares_end)
    return SegmentsMeet(
        outline.At(a), outline.At(b), outline.At(c), outline.At(d), outline.tolerance);
  // At fault only if one doubles back over the other.
  const int corner = shares_start ? a : b;
  const Eigen::Vector2d out = outline.At(shares_start ? b : a) - outline.At(corner);
  const Eigen::Vector2d back = outline.At(c == corner ? d : c) - outline.At(corner);
  const double shorter = std::min(out.norm(), back.norm());
  return out.dot(back) > 0 &&
         std::abs(Cross2(out, back)) <= outline.tolerance * std::max(out.norm(), back.norm()) &&
         shorter > outline.tolerance;
}

}  // namespace

std::optional<std::array<OutlineSide, 2>> FindMeetingSides(const Outline& outline,
                                                           const std::vector<OutlineSide>& sides) {
  // Sides sorted by their left end, so that only those overlapping in x are compared.
  std::vector<size_t> order(sides.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto left = [&](size_t i) {
    return std::min(outline.At(sides[i].start).x(), outline.At(sides[i].end).x());
  };
  const auto right = [&](size_t i) {
    return std::max(outline.At(sides[i].start).x(), outline.At(sides[i].end).x());
  };
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return left(a) < left(b); });
  for (size_t u = 0; u < order.size(); ++u) {
    for (size_t v = u + 1;
         v < order.size() && left(order[v]) <= right(order[u]) + outline.tolerance;
         ++v) {
      const size_t i = std::min(order[u], order[v]);
      const size_t k = std::max(order[u], order[v]);
      if (SidesMeet(outline, sides[i], sides[k]))
        return std::array<OutlineSide, 2>{sides[i], sides[k]};
    }
  }
  return std::nullopt;
}

}  // namespace groundglass
