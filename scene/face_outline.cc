// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/face_outline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace groundglass {
namespace {

double Cross2(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

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

// One number for all corners at exactly the same place: that of the first.
template <typename Point>
std::vector<int> WeldCorners(const std::vector<Point>& corners) {
  std::vector<int> order(corners.size());
  std::iota(order.begin(), order.end(), 0);
  const auto compare = [&](int a, int b) {
    for (int axis = 0; axis < corners[a].size(); ++axis) {
      if (corners[a][axis] != corners[b][axis]) {
        return corners[a][axis] < corners[b][axis] ? -1 : 1;
      }
    }
    return 0;
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const int sign = compare(a, b);
    return sign != 0 ? sign < 0 : a < b;
  });
  std::vector<int> weld(corners.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && compare(order[i - 1], order[i]) == 0;
    weld[order[i]] = is_same ? weld[order[i - 1]] : order[i];
  }
  return weld;
}

bool IsAnyRepeated(const std::vector<int>& weld) {
  for (size_t i = 0; i < weld.size(); ++i) {
    if (weld[i] != static_cast<int>(i)) return true;
  }
  return false;
}

std::vector<OutlineSide> AllSides(const std::vector<int>& weld) {
  std::vector<OutlineSide> sides;
  const int n = static_cast<int>(weld.size());
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    if (weld[i] != weld[next]) sides.push_back({i, next});
  }
  return sides;
}

// The sides that are not walked the other way as well.
std::vector<OutlineSide> WithoutBridges(const std::vector<OutlineSide>& sides,
                                        const std::vector<int>& weld) {
  std::map<std::pair<int, int>, std::vector<size_t>> open;  // not yet walked back
  std::vector<char> is_bridge(sides.size(), 0);
  for (size_t i = 0; i < sides.size(); ++i) {
    const std::pair<int, int> way(weld[sides[i].start], weld[sides[i].end]);
    const auto back = open.find({way.second, way.first});
    if (back != open.end() && !back->second.empty()) {
      is_bridge[i] = is_bridge[back->second.back()] = 1;
      back->second.pop_back();
    } else {
      open[way].push_back(i);
    }
  }
  std::vector<OutlineSide> left;
  for (size_t i = 0; i < sides.size(); ++i) {
    if (!is_bridge[i]) left.push_back(sides[i]);
  }
  return left;
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
    if (!result.meeting) Orient(result);
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

// Whether the way from a corner of the outline to a point starts into the outline's area.
bool StartsInside(const Eigen::Vector2d& previous,
                  const Eigen::Vector2d& corner,
                  const Eigen::Vector2d& next,
                  const Eigen::Vector2d& point) {
  const Eigen::Vector2d back = previous - corner;
  const Eigen::Vector2d out = next - corner;
  const Eigen::Vector2d way = point - corner;
  const double turn = Cross2(-back, out);
  if (turn == 0 && back.dot(out) > 0) return true;  // the end of a bridge
  if (turn >= 0) return Cross2(out, way) > 0 && Cross2(way, back) > 0;
  return !(Cross2(back, way) >= 0 && Cross2(way, out) >= 0);
}

// Whether the segment a-b has a point in common with p-q other than a or b.
bool IsBlocked(const Eigen::Vector2d& a,
               const Eigen::Vector2d& b,
               const Eigen::Vector2d& p,
               const Eigen::Vector2d& q) {
  const auto lies_between = [&](const Eigen::Vector2d& point) {
    return point != a && point != b && Cross2(b - a, point - a) == 0 &&
           (point - a).dot(b - a) > 0 && (point - b).dot(a - b) > 0;
  };
  if (lies_between(p) || lies_between(q)) return true;
  if (p == a || p == b || q == a || q == b) return false;
  const double p_side = Cross2(b - a, p - a);
  const double q_side = Cross2(b - a, q - a);
  const double a_side = Cross2(q - p, a - p);
  const double b_side = Cross2(q - p, b - p);
  return ((p_side > 0) != (q_side > 0)) && ((a_side > 0) != (b_side > 0));
}

// Joins a hole to the outline around it, from its rightmost corner (Eberly, Triangulation by Ear
// Clipping): holes that reach farther right are joined already, so some corner is in view.
void JoinHole(const std::vector<Eigen::Vector2d>& outline,
              std::vector<int> hole,
              std::vector<int>& joined) {
  std::rotate(
      hole.begin(),
      std::max_element(
          hole.begin(), hole.end(), [&](int a, int b) { return outline[a].x() < outline[b].x(); }),
      hole.end());
  const Eigen::Vector2d from = outline[hole[0]];
  const size_t n = joined.size();
  std::vector<std::pair<double, size_t>> candidates;
  for (size_t i = 0; i < n; ++i) {
    candidates.emplace_back((outline[joined[i]] - from).squaredNorm(), i);
  }
  std::sort(candidates.begin(), candidates.end());
  size_t place = candidates[0].second;
  for (const auto& [distance, i] : candidates) {
    const Eigen::Vector2d& to = outline[joined[i]];
    if (to.x() < from.x()) continue;
    if (!StartsInside(outline[joined[(i + n - 1) % n]], to, outline[joined[(i + 1) % n]], from)) {
      continue;
    }
    bool is_free = true;
    for (size_t k = 0; k < n && is_free; ++k) {
      is_free = !IsBlocked(from, to, outline[joined[k]], outline[joined[(k + 1) % n]]);
    }
    if (!is_free) continue;
    place = i;
    break;
  }
  std::vector<int> detour = hole;
  detour.push_back(hole[0]);
  detour.push_back(joined[place]);
  joined.insert(
      joined.begin() + static_cast<std::ptrdiff_t>(place) + 1, detour.begin(), detour.end());
}

}  // namespace

Eigen::Vector3d DoubledVectorArea(const PolygonModel& model, int face) {
  const std::vector<int>& points = model.faces[face].points;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = model.points_in_world[points[0]];
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    sum += (model.points_in_world[points[i]] - origin)
               .cross(model.points_in_world[points[i + 1]] - origin);
  }
  return sum;
}

std::vector<OutlineSide> FindBorders(const PolygonModel& model, int face) {
  std::vector<Eigen::Vector3d> corners;
  for (const int point : model.faces[face].points) corners.push_back(model.points_in_world[point]);
  const std::vector<int> weld = WeldCorners(corners);
  const std::vector<OutlineSide> sides = AllSides(weld);
  return IsAnyRepeated(weld) ? WithoutBridges(sides, weld) : sides;
}

OutlineLoops PartOutline(const std::vector<Eigen::Vector2d>& outline,
                         double tolerance,
                         bool look_for_meeting) {
  return OutlineParter(outline, tolerance).Part(look_for_meeting);
}

std::vector<std::vector<int>> BridgeHoles(const std::vector<Eigen::Vector2d>& outline,
                                          const OutlineLoops& loops) {
  std::vector<std::vector<int>> outlines;
  for (size_t i = 0; i < loops.loops.size(); ++i) {
    if (loops.loops[i].inside_of >= 0) continue;
    std::vector<int>& joined = outlines.emplace_back(loops.loops[i].corners);
    std::vector<std::pair<double, const std::vector<int>*>> holes;
    for (const OutlineLoops::Loop& hole : loops.loops) {
      if (hole.inside_of != static_cast<int>(i)) continue;
      double right = -1e300;
      for (const int corner : hole.corners) right = std::max(right, outline[corner].x());
      holes.emplace_back(right, &hole.corners);
    }
    std::stable_sort(
        holes.begin(), holes.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [right, corners] : holes) JoinHole(outline, *corners, joined);
  }
  return outlines;
}

}  // namespace groundglass
