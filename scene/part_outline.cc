// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/outline_sides.h"

#include <cmath>
#include <map>
#include <utility>

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

class OutlineParter {
 public:
  OutlineParter(const std::vector<Eigen::Vector2d>& outline, double tolerance)
      : outline_(outline),
        tolerance_(tolerance),
        weld_(WeldCorners(outline)),
        sides_(AllSides(weld_)) {}

  OutlineLoops Part(bool look_for_meeting) {
    OutlineLoops result;
    result.is_plain = !IsAnyRepeated(weld_);
    if (!result.is_plain) {
      sides_ = WithoutBridges(sides_, weld_);
      SplitSides();
      sides_ = WithoutBridges(sides_, weld_);
    }
    if (look_for_meeting) result.meeting = FindMeeting();
    if (result.meeting) return result;
    if (result.is_plain) {
      result.loops.emplace_back().corners.resize(outline_.size());
      std::iota(result.loops[0].corners.begin(), result.loops[0].corners.end(), 0);
      return result;
    }
    Trace(result);
    if (!result.meeting) {
      Orient(result);
    } else if (TurnTouchingRings()) {
      OutlineLoops turned = {{}, false, true, std::nullopt};
      Trace(turned);
      if (turned.meeting) return result;
      Orient(turned);
      turned.is_turned = true;
      return turned;
    }
    return result;
  }

 private:
  const Eigen::Vector2d& At(int corner) const { return outline_[corner]; }

  // Where a corner lies on a side, the side is two: bridges that coincide in part only, and holes
  // that touch, then have their ends in common.
  void SplitSides() {
    std::vector<OutlineSide> pieces;
    for (const OutlineSide& side : sides_) {
      const Eigen::Vector2d& a = At(side.start);
      const Eigen::Vector2d along = At(side.end) - a;
      const double length = along.norm();
      std::vector<std::pair<double, int>> between;
      for (int corner = 0; corner < static_cast<int>(weld_.size()); ++corner) {
        if (weld_[corner] != corner || corner == weld_[side.start] || corner == weld_[side.end]) {
          continue;
        }
        const double t = (At(corner) - a).dot(along) / length;
        if (t <= tolerance_ || t >= length - tolerance_) continue;
        if (std::abs(Cross2(along, At(corner) - a)) > tolerance_ * length) continue;
        between.emplace_back(t, corner);
      }
      std::sort(between.begin(), between.end());
      int start = side.start;
      for (const auto& [t, corner] : between) {
        pieces.push_back({start, corner});
        start = corner;
      }
      pieces.push_back({start, side.end});
    }
    sides_ = std::move(pieces);
  }

  // Whether two sides have more in common than an end.
  bool Meet(const OutlineSide& first, const OutlineSide& second) const {
    const int a = weld_[first.start];
    const int b = weld_[first.end];
    const int c = weld_[second.start];
    const int d = weld_[second.end];
    const bool shares_start = a == c || a == d;
    const bool shares_end = b == c || b == d;
    if (shares_start && shares_end) return true;
    if (!shares_start && !shares_end) return SegmentsMeet(At(a), At(b), At(c), At(d), tolerance_);
    // At fault only if one doubles back over the other.
    const int corner = shares_start ? a : b;
    const Eigen::Vector2d out = At(shares_start ? b : a) - At(corner);
    const Eigen::Vector2d back = At(c == corner ? d : c) - At(corner);
    const double shorter = std::min(out.norm(), back.norm());
    return out.dot(back) > 0 &&
           std::abs(Cross2(out, back)) <= tolerance_ * std::max(out.norm(), back.norm()) &&
           shorter > tolerance_;
  }

  std::optional<std::array<OutlineSide, 2>> FindMeeting() const {
    // Sides sorted by their left end, so that only those overlapping in x are compared.
    std::vector<size_t> order(sides_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    const auto left = [&](size_t i) {
      return std::min(At(sides_[i].start).x(), At(sides_[i].end).x());
    };
    const auto right = [&](size_t i) {
      return std::max(At(sides_[i].start).x(), At(sides_[i].end).x());
    };
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return left(a) < left(b); });
    for (size_t u = 0; u < order.size(); ++u) {
      for (size_t v = u + 1; v < order.size() && left(order[v]) <= right(order[u]) + tolerance_;
           ++v) {
        const size_t i = std::min(order[u], order[v]);
        const size_t k = std::max(order[u], order[v]);
        if (Meet(sides_[i], sides_[k])) return std::array<OutlineSide, 2>{sides_[i], sides_[k]};
      }
    }
    return std::nullopt;
  }

  // The angle by which one turns clockwise from `from` to `to`, in (0, 2 pi].
  static double ClockwiseAngle(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const double angle = -std::atan2(Cross2(from, to), from.dot(to));
    return angle > 0 ? angle : angle + 2 * M_PI;
  }

  // Follows the sides with the area on the left. Where loops touch, the sharpest turn to the left
  // keeps to the same piece of the area.
  void Trace(OutlineLoops& result) const {
    std::map<int, std::vector<size_t>> leaving;
    for (size_t i = 0; i < sides_.size(); ++i) leaving[weld_[sides_[i].start]].push_back(i);
    std::vector<size_t> next(sides_.size());
    std::vector<int> taken_by(sides_.size(), -1);
    for (size_t i = 0; i < sides_.size(); ++i) {
      const int corner = weld_[sides_[i].end];
      const Eigen::Vector2d back = At(sides_[i].start) - At(corner);
      size_t best = sides_.size();
      double best_angle = 100;
      for (const size_t candidate : leaving[corner]) {
        const double angle =
            ClockwiseAngle(back, Eigen::Vector2d(At(sides_[candidate].end) - At(corner)));
        if (angle < best_angle) {
          best_angle = angle;
          best = candidate;
        }
      }
      // Sides that come to a corner and sides that leave it alternate around it; else the area
      // covers itself there.
      if (best == sides_.size() || taken_by[best] >= 0) {
        const size_t other = best == sides_.size() ? i : static_cast<size_t>(taken_by[best]);
        result.meeting =
            std::array<OutlineSide, 2>{sides_[std::min(i, other)], sides_[std::max(i, other)]};
        return;
      }
      taken_by[best] = static_cast<int>(i);
      next[i] = best;
    }
    std::vector<char> is_used(sides_.size(), 0);
    for (size_t first = 0; first < sides_.size(); ++first) {
      if (is_used[first]) continue;
      OutlineLoops::Loop& loop = result.loops.emplace_back();
      for (size_t i = first; !is_used[i]; i = next[i]) {
        is_used[i] = 1;
        loop.corners.push_back(sides_[i].start);
      }
    }
  }

  // Where a hole that touches its outline runs the same way round, sides that come and sides that
  // leave do not alternate. Parts the outline into rings at the corners that it comes back to, and
  // turns those that run the wrong way. False if there are none.
  bool TurnTouchingRings() {
    std::map<int, std::vector<size_t>> leaving;
    for (size_t i = 0; i < sides_.size(); ++i) leaving[weld_[sides_[i].start]].push_back(i);
    std::vector<char> is_used(sides_.size(), 0);
    // The next side from this one's end, in the order in which the outline was written.
    const auto next_after = [&](size_t side) {
      size_t best = sides_.size();
      size_t best_steps = sides_.size();
      for (const size_t candidate : leaving[weld_[sides_[side].end]]) {
        const size_t steps = (candidate + sides_.size() - side) % sides_.size();
        if (is_used[candidate] || steps >= best_steps) continue;
        best = candidate;
        best_steps = steps;
      }
      return best;
    };
    OutlineLoops rings;
    for (size_t first = 0; first < sides_.size(); ++first) {
      if (is_used[first]) continue;
      std::vector<size_t> way;
      for (size_t side = first; side < sides_.size(); side = next_after(side)) {
        is_used[side] = 1;
        way.push_back(side);
        size_t start = way.size();
        while (start > 0 && weld_[sides_[way[start - 1]].start] != weld_[sides_[side].end]) --start;
        if (start == 0) continue;
        OutlineLoops::Loop& ring = rings.loops.emplace_back();
        for (size_t i = start - 1; i < way.size(); ++i) {
          ring.corners.push_back(sides_[way[i]].start);
        }
        way.resize(start - 1);
      }
      if (!way.empty()) return false;
    }
    Orient(rings);
    if (!rings.is_turned) return false;
    sides_.clear();
    for (const OutlineLoops::Loop& ring : rings.loops) {
      for (size_t i = 0; i < ring.corners.size(); ++i) {
        sides_.push_back({ring.corners[i], ring.corners[(i + 1) % ring.corners.size()]});
      }
    }
    return true;
  }

  double SignedArea(const OutlineLoops::Loop& loop) const {
    double sum = 0;
    const Eigen::Vector2d& origin = At(loop.corners[0]);
    for (size_t i = 1; i + 1 < loop.corners.size(); ++i) {
      sum += Cross2(At(loop.corners[i]) - origin, At(loop.corners[i + 1]) - origin);
    }
    return sum / 2;
  }

  bool IsInside(const OutlineLoops::Loop& loop, const Eigen::Vector2d& point) const {
    bool is_inside = false;
    for (size_t i = 0; i < loop.corners.size(); ++i) {
      const Eigen::Vector2d& a = At(loop.corners[i]);
      const Eigen::Vector2d& b = At(loop.corners[(i + 1) % loop.corners.size()]);
      if ((a.y() <= point.y()) == (b.y() <= point.y())) continue;
      if (a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > point.x()) {
        is_inside = !is_inside;
      }
    }
    return is_inside;
  }

  // The middle of the longest side: touching loops have corners in common, no sides.
  Eigen::Vector2d MiddleOfLongest(const OutlineLoops::Loop& loop) const {
    double longest = -1;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (size_t i = 0; i < loop.corners.size(); ++i) {
      const Eigen::Vector2d& a = At(loop.corners[i]);
      const Eigen::Vector2d& b = At(loop.corners[(i + 1) % loop.corners.size()]);
      if ((b - a).norm() <= longest) continue;
      longest = (b - a).norm();
      middle = (a + b) / 2;
    }
    return middle;
  }

  // Loops in an odd number of others are holes in the smallest of these.
  void Orient(OutlineLoops& result) const {
    std::vector<double> areas;
    for (const OutlineLoops::Loop& loop : result.loops) areas.push_back(SignedArea(loop));
    for (size_t i = 0; i < result.loops.size(); ++i) {
      const Eigen::Vector2d point = MiddleOfLongest(result.loops[i]);
      int depth = 0;
      int smallest = -1;
      for (size_t k = 0; k < result.loops.size(); ++k) {
        if (k == i || !IsInside(result.loops[k], point)) continue;
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

  const std::vector<Eigen::Vector2d>& outline_;
  double tolerance_;
  std::vector<int> weld_;
  std::vector<OutlineSide> sides_;
};

}  // namespace

OutlineLoops PartOutline(const std::vector<Eigen::Vector2d>& outline,
                         double tolerance,
                         bool look_for_meeting) {
  return OutlineParter(outline, tolerance).Part(look_for_meeting);
}

}  // namespace groundglass
