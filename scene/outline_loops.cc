// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/outline_loops.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace groundglass {
namespace {

// The angle by which one turns clockwise from `from` to `to`, in (0, 2 pi].
double ClockwiseAngle(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double angle = -std::atan2(Cross2(from, to), from.dot(to));
  return angle > 0 ? angle : angle + 2 * M_PI;
}

double SignedArea(const Outline& outline, const OutlineLoops::Loop& loop) {
  double sum = 0;
  const Eigen::Vector2d& origin = outline.At(loop.corners[0]);
  for (size_t i = 1; i + 1 < loop.corners.size(); ++i) {
    sum += Cross2(outline.At(loop.corners[i]) - origin, outline.At(loop.corners[i + 1]) - origin);
  }
  return sum / 2;
}

bool IsInsideLoop(const Outline& outline,
                  const OutlineLoops::Loop& loop,
                  const Eigen::Vector2d& point) {
  bool is_inside = false;
  for (size_t i = 0; i < loop.corners.size(); ++i) {
    const Eigen::Vector2d& a = outline.At(loop.corners[i]);
    const Eigen::Vector2d& b = outline.At(loop.corners[(i + 1) % loop.corners.size()]);
    if ((a.y() <= point.y()) == (b.y() <= point.y())) continue;
    if (a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > point.x()) {
      is_inside = !is_inside;
    }
  }
  return is_inside;
}

// The middle of the longest side: touching loops have corners in common, no sides.
Eigen::Vector2d MiddleOfLongest(const Outline& outline, const OutlineLoops::Loop& loop) {
  double longest = -1;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (size_t i = 0; i < loop.corners.size(); ++i) {
    const Eigen::Vector2d& a = outline.At(loop.corners[i]);
    const Eigen::Vector2d& b = outline.At(loop.corners[(i + 1) % loop.corners.size()]);
    if ((b - a).norm() <= longest) continue;
    longest = (b - a).norm();
    middle = (a + b) / 2;
  }
  return middle;
}

}  // namespace

void TraceLoops(const Outline& outline,
                const std::vector<OutlineSide>& sides,
                OutlineLoops& result) {
  std::map<int, std::vector<size_t>> leaving;
  for (size_t i = 0; i < sides.size(); ++i) leaving[outline.weld[sides[i].start]].push_back(i);
  std::vector<size_t> next(sides.size());
  std::vector<int> taken_by(sides.size(), -1);
  for (size_t i = 0; i < sides.size(); ++i) {
    const int corner = outline.weld[sides[i].end];
    const Eigen::Vector2d back = outline.At(sides[i].start) - outline.At(corner);
    size_t best = sides.size();
    double best_angle = 100;
    for (const size_t candidate : leaving[corner]) {
      const double angle = ClockwiseAngle(
          back, Eigen::Vector2d(outline.At(sides[candidate].end) - outline.At(corner)));
      if (angle < best_angle) {
        best_angle = angle;
        best = candidate;
      }
    }
    // Sides that come to a corner and sides that leave it alternate around it; else the area
    // covers itself there.
    if (best == sides.size() || taken_by[best] >= 0) {
      const size_t other = best == sides.size() ? i : static_cast<size_t>(taken_by[best]);
      result.meeting =
          std::array<OutlineSide, 2>{sides[std::min(i, other)], sides[std::max(i, other)]};
      return;
    }
    taken_by[best] = static_cast<int>(i);
    next[i] = best;
  }
  std::vector<char> is_used(sides.size(), 0);
  for (size_t first = 0; first < sides.size(); ++first) {
    if (is_used[first]) continue;
    OutlineLoops::Loop& loop = result.loops.emplace_back();
    for (size_t i = first; !is_used[i]; i = next[i]) {
      is_used[i] = 1;
      loop.corners.push_back(sides[i].start);
    }
  }
}

void OrientLoops(const Outline& outline, OutlineLoops& result) {
  std::vector<double> areas;
  for (const OutlineLoops::Loop& loop : result.loops) areas.push_back(SignedArea(outline, loop));
  for (size_t i = 0; i < result.loops.size(); ++i) {
    const Eigen::Vector2d point = MiddleOfLongest(outline, result.loops[i]);
    int depth = 0;
    int smallest = -1;
    for (size_t k = 0; k < result.loops.size(); ++k) {
      if (k == i || !IsInsideLoop(outline, result.loops[k], point)) continue;
      ++depth;
      if (smallest < 0 || std::abs(areas[k]) < std::abs(areas[smallest])) {
        smallest = static_cast<int>(k);
      }
    }
    const bool is_hole = depth % 2 == 1;
    if (is_hole) result.loops[i].inside_of = smallest;
    if ((areas[i] < 0) != is_hole) {
      std::reverse(result.loops[i].corners.begin(), result.loops[i].corners.end());
      result.is_turned = true;
    }
  }
}

}  // namespace groundglass
