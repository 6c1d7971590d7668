// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/plan/suggest_viewpoint.h"

#include "scene/back_share.h"
#include "scene/frames.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Whoever looks straight up at the back of a face stands under a roof, within the model: what a
// wall shows there is no facade.
bool IsUnderARoof(const Visibility& visibility, const Eigen::Vector3d& stand_in_world) {
  const auto above = visibility.FirstHit(stand_in_world, Eigen::Vector3d::UnitZ());
  return above && !above->is_front;
}

}  // namespace

std::optional<Eigen::Vector3d> SuggestViewpoint(const PolygonModel& model,
                                                const Visibility& visibility,
                                                int face,
                                                const Eigen::Vector3d& target_in_world,
                                                const ViewpointOptions& options) {
  const double eye = options.eye_level_ft * kMetresPerFoot / MetresPerUnit(model.unit);
  double lowest = 1e300;
  for (const Eigen::Vector3d& point : model.points_in_world) lowest = std::min(lowest, point.z());
  double size = 0;
  for (const int point : model.faces[face].points) {
    size = std::max(size, (model.points_in_world[point] - target_in_world).norm());
  }
  const Eigen::Vector3d normal = ComputeFacePlane(model, face).normal_in_world;
  const double tolerance = visibility.DefaultTolerance();
  for (const bool at_eye_level : {true, false}) {
    for (const double turn_deg : options.turns_deg) {
      for (const double sizes : options.distances) {
        const Eigen::AngleAxisd turn(turn_deg * M_PI / 180, Eigen::Vector3d::UnitZ());
        Eigen::Vector3d stand = target_in_world + sizes * size * (turn * normal);
        if (at_eye_level) stand.z() = lowest + eye;
        const Eigen::Vector3d from_target = stand - target_in_world;
        if (stand.z() < lowest + eye - tolerance) continue;
        if (from_target.normalized().dot(normal) < options.least_cosine) continue;
        if (!visibility.IsClear(stand, target_in_world, tolerance)) continue;
        if (IsUnderARoof(visibility, stand)) continue;
        if (BackShare(visibility, stand) <= options.most_backs) return stand;
      }
    }
  }
  return std::nullopt;
}

}  // namespace groundglass
