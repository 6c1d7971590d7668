// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/model_io.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace groundglass {
namespace {

// A face is planar if its points lie within this share of its size from its best plane.
constexpr double kPlanarShare = 1e-3;
// Less area than this share of the size squared is none.
constexpr double kZeroAreaShare = 1e-9;
// Points nearer to a line than this share of the size lie on it.
constexpr double kTouchShare = 1e-9;

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

// The two sides (counted from 0) that meet where they should not; nothing for a simple outline.
bool FindCrossing(const std::vector<Eigen::Vector2d>& outline,
                  double tolerance,
                  size_t& first,
                  size_t& second) {
  const size_t n = outline.size();
  // Sides sorted by their left end, so that only those overlapping in x are compared.
  std::vector<size_t> order(n);
  for (size_t i = 0; i < n; ++i) order[i] = i;
  const auto left = [&](size_t i) { return std::min(outline[i].x(), outline[(i + 1) % n].x()); };
  const auto right = [&](size_t i) { return std::max(outline[i].x(), outline[(i + 1) % n].x()); };
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return left(a) < left(b); });
  for (size_t u = 0; u < n; ++u) {
    for (size_t v = u + 1; v < n && left(order[v]) <= right(order[u]) + tolerance; ++v) {
      const size_t i = std::min(order[u], order[v]);
      const size_t k = std::max(order[u], order[v]);
      const Eigen::Vector2d& a = outline[i];
      const Eigen::Vector2d& b = outline[(i + 1) % n];
      const Eigen::Vector2d& c = outline[k];
      const Eigen::Vector2d& d = outline[(k + 1) % n];
      bool crosses = false;
      if (k == i + 1 || (i == 0 && k == n - 1)) {
        // Neighbours share a corner; they are at fault only if one doubles back over the other.
        const Eigen::Vector2d& corner = k == i + 1 ? b : a;
        const Eigen::Vector2d out = (k == i + 1 ? a : b) - corner;
        const Eigen::Vector2d back = (k == i + 1 ? d : c) - corner;
        const double shorter = std::min(out.norm(), back.norm());
        crosses = out.dot(back) > 0 &&
                  std::abs(Cross2(out, back)) <= tolerance * std::max(out.norm(), back.norm()) &&
                  shorter > tolerance;
      } else {
        crosses = SegmentsMeet(a, b, c, d, tolerance);
      }
      if (crosses) {
        first = i;
        second = k;
        return true;
      }
    }
  }
  return false;
}

}  // namespace

FaceCheck CheckFace(const PolygonModel& model, int face_index) {
  FaceCheck check;
  const Face& face = model.faces[static_cast<size_t>(face_index)];
  const int num_points = static_cast<int>(model.points_in_world.size());
  const size_t n = face.points.size();
  const auto number = [](int point) { return std::to_string(point + 1); };
  if (n < 3) {
    check.fault = "has " + std::to_string(n) + " points; a face needs at least 3";
    return check;
  }
  for (const int point : face.points) {
    if (point < 0 || point >= num_points) {
      check.fault =
          "uses point " + number(point) + ", which is outside 1 to " + std::to_string(num_points);
      return check;
    }
  }
  std::vector<int> sorted = face.points;
  std::sort(sorted.begin(), sorted.end());
  const auto repeated = std::adjacent_find(sorted.begin(), sorted.end());
  if (repeated != sorted.end()) {
    check.fault = "has point " + number(*repeated) + " more than once";
    return check;
  }

  Eigen::Vector3d low = model.points_in_world[static_cast<size_t>(face.points[0])];
  Eigen::Vector3d high = low;
  for (const int point : face.points) {
    low = low.cwiseMin(model.points_in_world[static_cast<size_t>(point)]);
    high = high.cwiseMax(model.points_in_world[static_cast<size_t>(point)]);
  }
  const double size = (high - low).norm();
  const double tolerance = kTouchShare * size;
  for (size_t i = 0; i < n; ++i) {
    const int here = face.points[i];
    const int next = face.points[(i + 1) % n];
    if ((model.points_in_world[static_cast<size_t>(here)] -
         model.points_in_world[static_cast<size_t>(next)])
            .norm() <= tolerance) {
      check.fault = "has a repeated point: " + number(here) + " and " + number(next) +
                    " are at the same place";
      return check;
    }
  }

  const FacePlane plane = ComputeFacePlane(model, face_index);
  const Eigen::Vector3d u = plane.normal_in_world.unitOrthogonal();
  const Eigen::Vector3d v = plane.normal_in_world.cross(u);
  std::vector<Eigen::Vector2d> outline;
  double deviation = 0;
  for (const int point : face.points) {
    const Eigen::Vector3d& position = model.points_in_world[static_cast<size_t>(point)];
    outline.emplace_back(u.dot(position - low), v.dot(position - low));
    deviation = std::max(deviation, std::abs(plane.normal_in_world.dot(position) - plane.offset));
  }
  const bool has_area = ComputeFaceArea(model, face_index) > kZeroAreaShare * size * size;
  size_t first = 0;
  size_t second = 0;
  if (has_area && FindCrossing(outline, tolerance, first, second)) {
    check.fault = "crosses or touches itself: its sides " + number(face.points[first]) + "-" +
                  number(face.points[(first + 1) % n]) + " and " + number(face.points[second]) +
                  "-" + number(face.points[(second + 1) % n]) + " meet";
    return check;
  }
  if (!has_area) {
    check.fault = "has no area: its points lie on a line, or its parts cancel out";
    return check;
  }
  if (deviation > kPlanarShare * size) {
    char text[128];
    std::snprintf(text,
                  sizeof(text),
                  "is %.2g %% of its size out of plane; its best plane is used",
                  100 * deviation / size);
    check.warning = text;
  }
  return check;
}

}  // namespace groundglass
