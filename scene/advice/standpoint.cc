// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/advice/standpoint.h"

#include "scene/back_share.h"
#include "scene/frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace groundglass {
namespace {

// Rays across and down the frame: enough to tell 2 % of it.
constexpr int kRaysAcross = 15;
constexpr int kRaysDown = 10;
// Of the directions around a camera, the share that must meet backs for it to stand inside.
constexpr double kSurroundedShare = 0.9;

bool IsBelowGround(const Box& bounds,
                   const Visibility& visibility,
                   const PolygonModel& model,
                   const Eigen::Vector3d& position,
                   bool flips_faces) {
  const double height = bounds.max.z() - bounds.min.z();
  // Under a face that looks up and lies near the model's foot: a lawn, a pavement.
  const auto above = visibility.FirstHit(position, Eigen::Vector3d::UnitZ());
  if (above && above->is_front == flips_faces &&
      std::abs(ComputeFacePlane(model, above->face).normal_in_world.z()) > 0.8 &&
      position.z() + above->distance < bounds.min.z() + 0.1 * height) {
    return true;
  }
  // Buildings stand on hills: only what no slope explains.
  const double depth = bounds.min.z() - position.z();
  const Eigen::Vector3d nearest = position.cwiseMax(bounds.min).cwiseMin(bounds.max);
  const double away = (nearest - position).head<2>().norm();
  return depth > 0.3 * height && depth > 0.5 * away;
}

double DistanceToTriangle(const Eigen::Vector3d& point,
                          const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c) {
  // The foot of the perpendicular if it lies inside, else the nearest point of a side.
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  if (area2 > 0) {
    const Eigen::Vector3d foot = point - normal * (normal.dot(point - a) / area2);
    const auto is_left = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
      return normal.dot((to - from).cross(foot - from)) >= 0;
    };
    if (is_left(a, b) && is_left(b, c) && is_left(c, a)) return (point - foot).norm();
  }
  const auto to_side = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3d along = to - from;
    const double length2 = along.squaredNorm();
    const double t = length2 > 0 ? std::clamp(along.dot(point - from) / length2, 0.0, 1.0) : 0;
    return (from + t * along - point).norm();
  };
  return std::min({to_side(a, b), to_side(b, c), to_side(c, a)});
}

// Fills in what the look-at point lies on.
void LookUpSurface(const PolygonModel& model,
                   const Eigen::Vector3d& position,
                   const Eigen::Vector3d& lookat,
                   bool is_hidden,
                   bool flips_faces,
                   Standpoint& standpoint) {
  // Hand-written points lie this far off what they are on.
  constexpr double kNear = 0.03;
  const double distance = (lookat - position).norm();
  standpoint.lookat_gap = std::numeric_limits<double>::max();
  int num_near = 0;
  int num_backs = 0;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    double gap = std::numeric_limits<double>::max();
    for (const std::array<int, 3>& triangle : TriangulateFace(model, face)) {
      gap = std::min(gap,
                     DistanceToTriangle(lookat,
                                        model.points_in_world[triangle[0]],
                                        model.points_in_world[triangle[1]],
                                        model.points_in_world[triangle[2]]));
    }
    standpoint.lookat_gap = std::min(standpoint.lookat_gap, gap / distance);
    if (gap > kNear * distance) continue;
    ++num_near;
    const FacePlane plane = ComputeFacePlane(model, face);
    const double before = plane.normal_in_world.dot(position) - plane.offset;
    if ((flips_faces ? -before : before) < -kNear * distance) ++num_backs;
  }
  standpoint.looks_at_back = is_hidden && num_near > 0 && num_backs == num_near;
}

std::string BearingName(const Eigen::Vector3d& offset_in_world) {
  constexpr std::array<const char*, 8> kNames = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  const double turns =
      std::atan2(offset_in_world.x(), offset_in_world.y()) / (2 * std::numbers::pi);
  const int eighth = static_cast<int>(std::lround(8 * (turns + 1)));
  return kNames[static_cast<size_t>(eighth % 8)];
}

}  // namespace

Standpoint FindStandpoint(const Box& bounds,
                          const Visibility& visibility,
                          const PolygonModel& model,
                          const ViewTag& tag,
                          const ImageSize& size,
                          const OtherReading& reading) {
  Standpoint standpoint;
  standpoint.position_in_site = tag.position_in_site;
  const Camera camera = CameraFromTag(tag, size.width, size.height);
  // From the reading under trial to the model as it is held here.
  const Eigen::Matrix3d back = reading.linear.inverse();
  const auto held = [&](const Eigen::Vector3d& point) { return back * (point - reading.offset); };
  const Eigen::Vector3d position = held(camera.PositionInWorld());
  const Eigen::Vector3d lookat = held(WorldFromSite(tag.lookat_in_site));
  const Eigen::Vector3d middle = bounds.Center();
  const double lookat_distance = (lookat - position).norm();
  standpoint.bearing =
      BearingName(camera.PositionInWorld() - (reading.linear * middle + reading.offset));

  const auto direction_of = [&](const Eigen::Vector2d& image_px) {
    return Eigen::Vector3d((back * UnprojectToWorld(camera, image_px)).normalized());
  };
  const auto axis = visibility.FirstHit(position, (lookat - position).normalized());
  standpoint.distance = axis ? axis->distance : (middle - position).norm();
  if (axis) {
    standpoint.face = axis->face;
    standpoint.shows_front = axis->is_front != reading.flips_faces;
  }
  // A tag that was given as angles has its look-at point as far away as the model's middle.
  const double to_middle =
      (reading.linear * middle + reading.offset - camera.PositionInWorld()).norm();
  const double tag_distance = (tag.lookat_in_site - tag.position_in_site).norm();
  const bool has_lookat = std::abs(tag_distance - to_middle) > 1e-6 * tag_distance;
  standpoint.lookat_error =
      !axis ? 1
            : (has_lookat
                   ? std::min(1.0, std::abs(axis->distance - lookat_distance) / lookat_distance)
                   : 0);

  standpoint.size_share = lookat_distance / std::max(1e-12, bounds.Diagonal());
  if (has_lookat && standpoint.lookat_error > 0.05) {
    // A point above a roof's rim is near faces that are seen from behind, and in plain sight.
    const bool is_hidden = axis && axis->distance < lookat_distance;
    LookUpSurface(model, position, lookat, is_hidden, reading.flips_faces, standpoint);
  }

  int num_model = 0;
  int num_front = 0;
  for (int y = 0; y < kRaysDown; ++y) {
    for (int x = 0; x < kRaysAcross; ++x) {
      const auto hit = visibility.FirstHit(position,
                                           direction_of({(x + 0.5) * size.width / kRaysAcross,
                                                         (y + 0.5) * size.height / kRaysDown}));
      if (!hit) continue;
      ++num_model;
      if (hit->is_front != reading.flips_faces) ++num_front;
    }
  }
  standpoint.model_share = static_cast<double>(num_model) / (kRaysAcross * kRaysDown);
  standpoint.front_share = num_model > 0 ? static_cast<double>(num_front) / num_model : 1;
  const double to_model = std::max(1e-12, (middle - position).norm());
  standpoint.apparent_size = 2 * std::atan(bounds.Diagonal() / 2 / to_model) /
                             RadiansFromDegrees(std::max(1e-6, tag.view_angle_deg));

  standpoint.is_inside =
      BackShare(visibility, position, back, reading.flips_faces) >= kSurroundedShare;
  // The ground is where the model has its foot: a reading that turns it over is judged without.
  const bool keeps_up = (reading.linear * Eigen::Vector3d::UnitZ()).normalized().z() > 0.99;
  standpoint.is_below_ground =
      keeps_up && IsBelowGround(bounds, visibility, model, position, reading.flips_faces);
  return standpoint;
}

}  // namespace groundglass
