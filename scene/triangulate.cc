// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/outline_sides.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

bool IsInsideTriangle(const Eigen::Vector2d& p,
                      const Eigen::Vector2d& a,
                      const Eigen::Vector2d& b,
                      const Eigen::Vector2d& c) {
  return Cross2(b - a, p - a) >= 0 && Cross2(c - b, p - b) >= 0 && Cross2(a - c, p - c) >= 0;
}

// Ear clipping. Each corner that is no ear remembers one that stands in its way and is looked at
// again only when that one, or a neighbour, is gone. Ours, since Debian 12 has no free-standing
// library for it in C++ (CGAL's triangulations are under the GPL), and bridges to holes must stay.
class EarClipper {
 public:
  EarClipper(const std::vector<Eigen::Vector2d>& flat, const std::vector<int>& corners)
      : num_left_(static_cast<int>(corners.size())) {
    corners_ = corners;
    for (const int corner : corners) flat_.push_back(flat[corner]);
    for (int i = 0; i < num_left_; ++i) {
      previous_.push_back((i + num_left_ - 1) % num_left_);
      next_.push_back((i + 1) % num_left_);
      alive_.push_back(i);
    }
    quality_.resize(corners.size());
    witness_.resize(corners.size());
  }

  std::vector<std::array<int, 3>> Clip() {
    std::vector<std::array<int, 3>> triangles;
    if (num_left_ < 3) return triangles;
    for (const int i : alive_) Judge(i);
    while (alive_.size() > 3) {
      // Among the ears take the one with the best-shaped triangle, so that no sliver is left over.
      int best = -1;
      double best_quality = -1;
      for (const int i : alive_) {
        if (quality_[i] > best_quality) {
          best_quality = quality_[i];
          best = i;
        }
      }
      if (best >= 0) {
        triangles.push_back(Triangle(best));
      } else {
        best = FindFlat();
      }
      Remove(best);
    }
    triangles.push_back({corners_[alive_[0]], corners_[alive_[1]], corners_[alive_[2]]});
    return triangles;
  }

 private:
  std::array<int, 3> Triangle(int i) const {
    return {corners_[previous_[i]], corners_[i], corners_[next_[i]]};
  }

  // The shape of the ear at a corner; -1 if it is none.
  void Judge(int i) {
    quality_[i] = -1;
    witness_[i] = -1;
    const Eigen::Vector2d& a = flat_[previous_[i]];
    const Eigen::Vector2d& b = flat_[i];
    const Eigen::Vector2d& c = flat_[next_[i]];
    const double area = Cross2(b - a, c - a);
    if (area <= 0) return;
    for (const int other : alive_) {
      const Eigen::Vector2d& p = flat_[other];
      // Others at the same places belong to bridges: their sides lie beyond this corner's.
      if (p == a || p == b || p == c) continue;
      if (IsInsideTriangle(p, a, b, c)) {
        witness_[i] = other;
        return;
      }
    }
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    quality_[i] = area / longest;
  }

  // Only collinear corners are left to cut: they carry no area.
  int FindFlat() const {
    for (const int i : alive_) {
      const Eigen::Vector2d& a = flat_[previous_[i]];
      const Eigen::Vector2d& b = flat_[i];
      const Eigen::Vector2d& c = flat_[next_[i]];
      if (std::abs(Cross2(b - a, c - a)) <= 1e-12 * (b - a).norm() * (c - b).norm()) return i;
    }
    return alive_[0];
  }

  void Remove(int i) {
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    alive_.erase(std::lower_bound(alive_.begin(), alive_.end(), i));
    Judge(previous_[i]);
    Judge(next_[i]);
    for (const int other : alive_) {
      if (witness_[other] == i) Judge(other);
    }
  }

  int num_left_;
  std::vector<int> corners_;
  std::vector<Eigen::Vector2d> flat_;
  std::vector<int> previous_;
  std::vector<int> next_;
  std::vector<int> alive_;  // in the outline's order
  std::vector<double> quality_;
  std::vector<int> witness_;
};

}  // namespace

std::vector<std::array<int, 3>> TriangulateCorners(const PolygonModel& model, int face) {
  const std::vector<int>& points = model.faces[face].points;
  // Drop the normal's largest axis, keeping the winding counterclockwise in the plane.
  const Eigen::Vector3d normal = DoubledVectorArea(model, face);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const double sign = normal[axis] < 0 ? -1 : 1;
  std::vector<Eigen::Vector2d> flat;
  std::vector<int> corners;
  Box bounds;
  bounds.min = bounds.max = model.points_in_world[points[0]];
  for (const int point : points) {
    const Eigen::Vector3d& p = model.points_in_world[point];
    corners.push_back(static_cast<int>(flat.size()));
    flat.emplace_back(p[u], sign * p[v]);
    bounds.min = bounds.min.cwiseMin(p);
    bounds.max = bounds.max.cwiseMax(p);
  }
  if (points.size() == 3) return {{0, 1, 2}};
  const OutlineLoops loops = PartOutline(flat, 1e-9 * bounds.Diagonal(), false);
  // What is unsound is cut as it comes.
  if (loops.is_plain || loops.loops.empty()) return EarClipper(flat, corners).Clip();
  std::vector<std::array<int, 3>> triangles;
  for (const std::vector<int>& outline : BridgeHoles(flat, loops)) {
    for (const std::array<int, 3>& t : EarClipper(flat, outline).Clip()) {
      if (Cross2(flat[t[1]] - flat[t[0]], flat[t[2]] - flat[t[0]]) > 0) triangles.push_back(t);
    }
  }
  return triangles;
}

std::vector<std::array<int, 3>> TriangulateFace(const PolygonModel& model, int face) {
  const std::vector<int>& points = model.faces[face].points;
  std::vector<std::array<int, 3>> triangles = TriangulateCorners(model, face);
  for (std::array<int, 3>& triangle : triangles) {
    for (int& corner : triangle) corner = points[corner];
  }
  return triangles;
}

}  // namespace groundglass
