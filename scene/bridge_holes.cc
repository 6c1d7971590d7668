// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/outline_sides.h"

#include <utility>

namespace groundglass {
namespace {

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

// From left to right, and of those one above another upwards: windows often end on one line, and
// none of them may be skipped by a bridge that runs along it.
bool IsLeftOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

// Joins a hole to the outline around it, from its rightmost corner (Eberly, Triangulation by Ear
// Clipping): holes that reach farther right are joined already, so some corner is in view, and none
// that is not joined yet can lie between.
void JoinHole(const std::vector<Eigen::Vector2d>& outline,
              std::vector<int> hole,
              std::vector<int>& joined) {
  std::rotate(
      hole.begin(),
      std::max_element(
          hole.begin(), hole.end(), [&](int a, int b) { return IsLeftOf(outline[a], outline[b]); }),
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
    if (IsLeftOf(to, from)) continue;
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

std::vector<std::vector<int>> BridgeHoles(const std::vector<Eigen::Vector2d>& outline,
                                          const OutlineLoops& loops) {
  std::vector<std::vector<int>> outlines;
  for (size_t i = 0; i < loops.loops.size(); ++i) {
    if (loops.loops[i].inside_of >= 0) continue;
    std::vector<int>& joined = outlines.emplace_back(loops.loops[i].corners);
    struct Hole {
      Eigen::Vector2d rightmost;
      const std::vector<int>* corners;
    };
    std::vector<Hole> holes;
    for (const OutlineLoops::Loop& hole : loops.loops) {
      if (hole.inside_of != static_cast<int>(i)) continue;
      Eigen::Vector2d rightmost = outline[hole.corners[0]];
      for (const int corner : hole.corners) {
        if (IsLeftOf(rightmost, outline[corner])) rightmost = outline[corner];
      }
      holes.push_back({rightmost, &hole.corners});
    }
    std::stable_sort(holes.begin(), holes.end(), [](const Hole& a, const Hole& b) {
      return IsLeftOf(b.rightmost, a.rightmost);
    });
    for (const Hole& hole : holes) JoinHole(outline, *hole.corners, joined);
  }
  return outlines;
}

}  // namespace groundglass
