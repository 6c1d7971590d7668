// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/check_face.h"

#include "scene/face_outline.h"

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
      if (here == next) {
        check.fault = "has point " + number(here) + " more than once";
        return check;
      }
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
  std::optional<std::array<OutlineSide, 2>> meeting;
  if (has_area) {
    const OutlineLoops loops = PartOutline(outline, tolerance, true);
    meeting = loops.meeting;
    if (loops.is_turned) {
      check.fault = "has a hole that runs the same way round as its outline";
      return check;
    }
  }
  if (meeting || !has_area) {
    // Most likely a slip of the pen in a file written by hand.
    std::vector<int> sorted = face.points;
    std::sort(sorted.begin(), sorted.end());
    const auto repeated = std::adjacent_find(sorted.begin(), sorted.end());
    if (repeated != sorted.end()) {
      check.fault = "has point " + number(*repeated) + " more than once";
      return check;
    }
  }
  if (meeting) {
    const auto name = [&](const OutlineSide& side) {
      return number(face.points[static_cast<size_t>(side.start)]) + "-" +
             number(face.points[static_cast<size_t>(side.end)]);
    };
    check.fault = "crosses or touches itself: its sides " + name((*meeting)[0]) + " and " +
                  name((*meeting)[1]) + " meet";
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
