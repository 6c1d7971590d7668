// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/polygon_model.h"

#include <cmath>

namespace groundglass {
namespace {

// Twice the face's vector area (Newell): its direction is the normal, its length twice the area.
Eigen::Vector3d DoubledVectorArea(const PolygonModel& model, const Face& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = model.points_in_world[face.points[0]];
  for (size_t i = 1; i + 1 < face.points.size(); ++i) {
    sum += (model.points_in_world[face.points[i]] - origin)
               .cross(model.points_in_world[face.points[i + 1]] - origin);
  }
  return sum;
}

double Cross2(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool IsInsideTriangle(const Eigen::Vector2d& p,
                      const Eigen::Vector2d& a,
                      const Eigen::Vector2d& b,
                      const Eigen::Vector2d& c) {
  return Cross2(b - a, p - a) >= 0 && Cross2(c - b, p - b) >= 0 && Cross2(a - c, p - c) >= 0;
}

}  // namespace

FacePlane ComputeFacePlane(const PolygonModel& model, int face) {
  const Face& polygon = model.faces[face];
  FacePlane plane;
  plane.normal_in_world = DoubledVectorArea(model, polygon).normalized();
  for (const int point : polygon.points) {
    plane.offset += plane.normal_in_world.dot(model.points_in_world[point]);
  }
  plane.offset /= static_cast<double>(polygon.points.size());
  return plane;
}

double ComputeFaceArea(const PolygonModel& model, int face) {
  return DoubledVectorArea(model, model.faces[face]).norm() / 2;
}

std::vector<std::array<int, 3>> TriangulateFace(const PolygonModel& model, int face) {
  const Face& polygon = model.faces[face];
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> remaining = polygon.points;
  // Drop the normal's largest axis, keeping the winding counterclockwise in the plane.
  const Eigen::Vector3d normal = DoubledVectorArea(model, polygon);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const double sign = normal[axis] < 0 ? -1 : 1;
  const auto flat = [&](int point) {
    const Eigen::Vector3d& p = model.points_in_world[point];
    return Eigen::Vector2d(p[u], sign * p[v]);
  };
  while (remaining.size() > 3) {
    const size_t n = remaining.size();
    // Among the ears take the one with the best-shaped triangle, so that no sliver is left over.
    size_t best = n;
    double best_quality = -1;
    for (size_t i = 0; i < n; ++i) {
      const int previous = remaining[(i + n - 1) % n];
      const int next = remaining[(i + 1) % n];
      const Eigen::Vector2d a = flat(previous);
      const Eigen::Vector2d b = flat(remaining[i]);
      const Eigen::Vector2d c = flat(next);
      const double area = Cross2(b - a, c - a);
      if (area <= 0) continue;
      bool is_ear = true;
      for (const int other : remaining) {
        if (other == previous || other == remaining[i] || other == next) continue;
        const Eigen::Vector2d p = flat(other);
        if (p == a || p == b || p == c) continue;
        if (IsInsideTriangle(p, a, b, c)) {
          is_ear = false;
          break;
        }
      }
      if (!is_ear) continue;
      const double longest =
          std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
      const double quality = area / longest;
      if (quality > best_quality) {
        best_quality = quality;
        best = i;
      }
    }
    // Only collinear corners are left to cut: they carry no area.
    if (best == n) {
      for (size_t i = 0; i < n && best == n; ++i) {
        const Eigen::Vector2d a = flat(remaining[(i + n - 1) % n]);
        const Eigen::Vector2d b = flat(remaining[i]);
        const Eigen::Vector2d c = flat(remaining[(i + 1) % n]);
        if (std::abs(Cross2(b - a, c - a)) <= 1e-12 * (b - a).norm() * (c - b).norm()) best = i;
      }
      if (best == n) best = 0;
    } else {
      triangles.push_back(
          {remaining[(best + n - 1) % n], remaining[best], remaining[(best + 1) % n]});
    }
    remaining.erase(remaining.begin() + static_cast<std::ptrdiff_t>(best));
  }
  triangles.push_back({remaining[0], remaining[1], remaining[2]});
  return triangles;
}

Box ComputeBounds(const PolygonModel& model) {
  Box box;
  if (model.points_in_world.empty()) return box;
  box.min = box.max = model.points_in_world.front();
  for (const Eigen::Vector3d& point : model.points_in_world) {
    box.min = box.min.cwiseMin(point);
    box.max = box.max.cwiseMax(point);
  }
  return box;
}

std::string DescribeFace(const PolygonModel& model, int face) {
  std::string text = "face " + std::to_string(face + 1);
  if (!model.faces[face].name.empty()) text += " (" + model.faces[face].name + ")";
  return text;
}

}  // namespace groundglass
