// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/check_face.h"

#include "scene/face_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace groundglass {
namespace {

// A face is planar if its points lie within this share of its size from its best plane.
constexpr double kPlanarShare = 1e-3;
// Less area than this share of the size squared is none.
constexpr double kZeroAreaShare = 1e-9;
// Points nearer to a line than this share of the size lie on it.
constexpr double kTouchShare = 1e-9;

std::string PointNumber(int point) { return std::to_string(point + 1); }

const Eigen::Vector3d& CornerInWorld(const PolygonModel& model, const Face& face, size_t corner) {
  return model.points_in_world[static_cast<size_t>(face.points[corner])];
}

// Too few points, or points that there are not. Faults are empty where there is none.
std::string FindFaultOfPoints(const PolygonModel& model, const Face& face) {
  const int num_points = static_cast<int>(model.points_in_world.size());
  if (face.points.size() < 3) {
    return "has " + std::to_string(face.points.size()) + " points; a face needs at least 3";
  }
  for (const int point : face.points) {
    if (point < 0 || point >= num_points) {
      return "uses point " + PointNumber(point) + ", which is outside 1 to " +
             std::to_string(num_points);
    }
    if (!model.points_in_world[static_cast<size_t>(point)].allFinite()) {
      return "uses point " + PointNumber(point) + ", whose coordinates are not finite numbers";
    }
  }
  return "";
}

// Neighbouring corners at one place.
std::string FindRepeatedCorner(const PolygonModel& model, const Face& face, double tolerance) {
  for (size_t i = 0; i < face.points.size(); ++i) {
    const size_t after = (i + 1) % face.points.size();
    const double length =
        (CornerInWorld(model, face, i) - CornerInWorld(model, face, after)).norm();
    if (length > tolerance) continue;
    const int here = face.points[i];
    const int next = face.points[after];
    if (here == next) return "has point " + PointNumber(here) + " more than once";
    return "has a repeated point: " + PointNumber(here) + " and " + PointNumber(next) +
           " are at the same place";
  }
  return "";
}

// The face's corners in its best plane, counterclockwise as it is seen, and how far they lie from
// that plane at most.
struct FlatOutline {
  std::vector<Eigen::Vector2d> corners;
  double deviation = 0;
};
FlatOutline Flatten(const PolygonModel& model, int face, const Eigen::Vector3d& origin) {
  const FacePlane plane = ComputeFacePlane(model, face);
  const Eigen::Vector3d u = plane.normal_in_world.unitOrthogonal();
  const Eigen::Vector3d v = plane.normal_in_world.cross(u);
  FlatOutline flat;
  for (const int point : model.faces[static_cast<size_t>(face)].points) {
    const Eigen::Vector3d& position = model.points_in_world[static_cast<size_t>(point)];
    flat.corners.emplace_back(u.dot(position - origin), v.dot(position - origin));
    flat.deviation =
        std::max(flat.deviation, std::abs(plane.normal_in_world.dot(position) - plane.offset));
  }
  return flat;
}

// An outline without area, or one that meets itself.
std::string FindFaultOfOutline(const Face& face,
                               const std::vector<Eigen::Vector2d>& outline,
                               double tolerance,
                               bool has_area) {
  std::optional<std::array<OutlineSide, 2>> meeting;
  if (has_area) {
    const OutlineLoops loops = PartOutline(outline, tolerance, true);
    meeting = loops.meeting;
    if (loops.is_turned) return "has a hole that runs the same way round as its outline";
  }
  if (has_area && !meeting) return "";
  // Most likely a slip of the pen in a file written by hand.
  std::vector<int> sorted = face.points;
  std::sort(sorted.begin(), sorted.end());
  const auto repeated = std::adjacent_find(sorted.begin(), sorted.end());
  if (repeated != sorted.end()) return "has point " + PointNumber(*repeated) + " more than once";
  if (!meeting) return "has no area: its points lie on a line, or its parts cancel out";
  const auto name = [&](const OutlineSide& side) {
    return PointNumber(face.points[static_cast<size_t>(side.start)]) + "-" +
           PointNumber(face.points[static_cast<size_t>(side.end)]);
  };
  return "crosses or touches itself: its sides " + name((*meeting)[0]) + " and " +
         name((*meeting)[1]) + " meet";
}

}  // namespace

FaceCheck CheckFace(const PolygonModel& model, int face_index) {
  FaceCheck check;
  const Face& face = model.faces[static_cast<size_t>(face_index)];
  check.fault = FindFaultOfPoints(model, face);
  if (!check.fault.empty()) return check;
  Eigen::Vector3d low = CornerInWorld(model, face, 0);
  Eigen::Vector3d high = low;
  for (size_t i = 1; i < face.points.size(); ++i) {
    low = low.cwiseMin(CornerInWorld(model, face, i));
    high = high.cwiseMax(CornerInWorld(model, face, i));
  }
  const double size = (high - low).norm();
  const double tolerance = kTouchShare * size;
  check.fault = FindRepeatedCorner(model, face, tolerance);
  if (!check.fault.empty()) return check;

  const FlatOutline flat = Flatten(model, face_index, low);
  const bool has_area = ComputeFaceArea(model, face_index) > kZeroAreaShare * size * size;
  check.fault = FindFaultOfOutline(face, flat.corners, tolerance, has_area);
  if (!check.fault.empty()) return check;
  check.out_of_plane_share = flat.deviation / size;
  if (check.out_of_plane_share > kPlanarShare) {
    check.warning = fmt::format("is {:.2g} % of its size out of plane; its best plane is used",
                                100 * check.out_of_plane_share);
  }
  return check;
}

}  // namespace groundglass
