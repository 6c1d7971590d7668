// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/picking.h"

#include <algorithm>

namespace groundglass {
namespace {

double DistanceFromSegment(const Eigen::Vector2d& start,
                           const Eigen::Vector2d& end,
                           const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = end - start;
  const double share =
      std::clamp((point - start).dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
  return (point - start - share * along).norm();
}

}  // namespace

std::optional<FacePick> PickFace(const Visibility& visibility,
                                 const Camera& camera,
                                 const Eigen::Vector2d& image_px) {
  const Eigen::Vector3d from = camera.PositionInWorld();
  const Eigen::Vector3d along = UnprojectToWorld(camera, image_px);
  const auto hit = visibility.FirstHit(from, along);
  if (!hit) return std::nullopt;
  return FacePick{hit->face, from + hit->distance * along};
}

std::vector<VisibleCorner> FindVisibleCorners(const PolygonModel& model,
                                              const Visibility& visibility,
                                              const Camera& camera) {
  std::vector<VisibleCorner> corners;
  const Eigen::Vector3d from = camera.PositionInWorld();
  const double tolerance = visibility.DefaultTolerance();
  for (size_t i = 0; i < model.points_in_world.size(); ++i) {
    const Eigen::Vector3d& point = model.points_in_world[i];
    const auto image_px = Project(camera, point);
    if (!image_px || !IsInsideFrame(camera, *image_px)) continue;
    if (!visibility.IsClear(from, point, tolerance)) continue;
    corners.push_back({static_cast<int>(i), *image_px});
  }
  std::stable_sort(
      corners.begin(), corners.end(), [](const VisibleCorner& a, const VisibleCorner& b) {
        return a.image_px.x() < b.image_px.x();
      });
  return corners;
}

std::optional<VisibleCorner> PickCorner(const std::vector<VisibleCorner>& corners,
                                        const Eigen::Vector2d& image_px,
                                        double reach_px) {
  std::optional<VisibleCorner> nearest;
  for (const VisibleCorner& corner : corners) {
    const double distance = (corner.image_px - image_px).norm();
    if (distance > reach_px) continue;
    if (!nearest || distance < (nearest->image_px - image_px).norm()) nearest = corner;
  }
  return nearest;
}

std::optional<int> PickSpan(const std::vector<VisibleSpan>& spans,
                            const Camera& camera,
                            const Eigen::Vector2d& image_px,
                            double reach_px) {
  std::optional<int> nearest;
  double nearest_px = reach_px;
  for (size_t i = 0; i < spans.size(); ++i) {
    const auto start = Project(camera, spans[i].start_in_world);
    const auto end = Project(camera, spans[i].end_in_world);
    if (!start || !end) continue;
    const double distance = DistanceFromSegment(*start, *end, image_px);
    if (distance > nearest_px) continue;
    nearest_px = distance;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

}  // namespace groundglass
