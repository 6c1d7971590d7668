// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/photos/earlier_model.h"

#include "invrender/charts/spread_points.h"
#include "invrender/photos/face_mask.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace groundglass {

EarlierModel::EarlierModel(const PolygonModel& earlier,
                           const PolygonModel& now,
                           const EarlierModelOptions& options)
    : earlier_(earlier),
      now_(now),
      visibility_(earlier),
      visibility_now_(now),
      options_(options),
      tolerance_(std::max(visibility_.DefaultTolerance(), visibility_now_.DefaultTolerance())) {}

std::vector<int> EarlierModel::FindNewFaces() const {
  std::vector<int> new_faces;
  for (int face = 0; face < static_cast<int>(now_.faces.size()); ++face) {
    const Eigen::Vector3d normal = ComputeFacePlane(now_, face).normal_in_world;
    const std::vector<Eigen::Vector3d> points = SpreadPoints(now_, face);
    const bool was_there = std::any_of(points.begin(), points.end(), [&](const auto& point) {
      const auto hit =
          visibility_.FirstHit(point + tolerance_ * normal, -normal, 0, 2 * tolerance_);
      if (!hit || !hit->is_front) return false;
      const Eigen::Vector3d other = ComputeFacePlane(earlier_, hit->face).normal_in_world;
      return other.dot(normal) > options_.same_normal_cosine;
    });
    if (!was_there) new_faces.push_back(face);
  }
  return new_faces;
}

Image16 EarlierModel::MakeFaceMask(const Camera& camera) const {
  Image16 labels = groundglass::MakeFaceMask(earlier_, visibility_, camera);
  std::vector<FacePlane> planes;
  for (int face = 0; face < static_cast<int>(earlier_.faces.size()); ++face) {
    planes.push_back(ComputeFacePlane(earlier_, face));
  }
  const Eigen::Vector3d position = camera.PositionInWorld();
  tbb::parallel_for(0, labels.height, [&](int y) {
    for (int x = 0; x < labels.width; ++x) {
      uint16_t& label = *labels.At(x, y);
      if (label == 0) continue;
      const FacePlane& plane = planes[label - 1];
      const Eigen::Vector3d direction = UnprojectToWorld(camera, {x + 0.5, y + 0.5});
      const double distance = (plane.offset - plane.normal_in_world.dot(position)) /
                              plane.normal_in_world.dot(direction);
      const auto hit = visibility_now_.FirstHit(
          position, direction, distance - tolerance_, distance + tolerance_);
      label = static_cast<uint16_t>(hit && hit->is_front ? hit->face + 1 : 0);
    }
  });
  return labels;
}

bool EarlierModel::Shows(const Eigen::Vector3d& from_in_world,
                         const Eigen::Vector3d& point_in_world) const {
  const Eigen::Vector3d to_point = point_in_world - from_in_world;
  const double distance = to_point.norm();
  const auto hit = visibility_.FirstHit(from_in_world, to_point / distance);
  return hit && hit->is_front && std::abs(hit->distance - distance) <= 2 * tolerance_;
}

}  // namespace groundglass
