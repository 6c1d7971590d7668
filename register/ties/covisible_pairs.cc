// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/covisible_pairs.h"

#include "scene/check_option.h"
#include "scene/view_tag.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

struct SeenPlace {
  Eigen::Vector3d point_in_world;
  Eigen::Vector3d normal_in_world;
};

bool IsSeenWellEnough(const SeenPlace& place,
                      const Eigen::Vector3d& position_in_world,
                      const CovisibleOptions& options) {
  const Eigen::Vector3d to_camera = position_in_world - place.point_in_world;
  return to_camera.dot(place.normal_in_world) >=
         std::cos(RadiansFromDegrees(options.max_angle_deg)) * to_camera.norm();
}

std::vector<SeenPlace> PlacesSeenBy(const Camera& camera,
                                    const Visibility& visibility,
                                    const std::vector<Eigen::Vector3d>& normals_in_world,
                                    const CovisibleOptions& options) {
  std::vector<SeenPlace> places;
  const Eigen::Vector3d position_in_world = camera.PositionInWorld();
  const double step_px = static_cast<double>(camera.width_px) / options.grid_columns;
  for (double y = 0.5 * step_px; y < camera.height_px; y += step_px) {
    for (double x = 0.5 * step_px; x < camera.width_px; x += step_px) {
      const Eigen::Vector3d direction_in_world = UnprojectToWorld(camera, {x, y});
      const auto hit = visibility.FirstHit(position_in_world, direction_in_world);
      if (!hit || !hit->is_front) continue;
      const SeenPlace place = {position_in_world + hit->distance * direction_in_world,
                               normals_in_world[hit->face]};
      if (IsSeenWellEnough(place, position_in_world, options)) places.push_back(place);
    }
  }
  return places;
}

// How many of the places another camera sees too.
double ShareSeenBy(const Camera& camera,
                   const std::vector<SeenPlace>& places,
                   const Visibility& visibility,
                   const CovisibleOptions& options) {
  if (places.empty()) return 0;
  const Eigen::Vector3d position_in_world = camera.PositionInWorld();
  const auto num_seen = std::count_if(places.begin(), places.end(), [&](const SeenPlace& place) {
    if (!IsSeenWellEnough(place, position_in_world, options)) return false;
    const auto image_px = Project(camera, place.point_in_world);
    return image_px && IsInsideFrame(camera, *image_px) &&
           visibility.IsClear(
               position_in_world, place.point_in_world, visibility.DefaultTolerance());
  });
  return static_cast<double>(num_seen) / static_cast<double>(places.size());
}

}  // namespace

void CovisibleOptions::Check(const std::string& path) const {
  CheckFromTo(grid_columns, 1, 1000, path + "grid_columns");
  CheckFromTo(least_share, 0, 1, path + "least_share");
  CheckFromTo(max_angle_deg, 0, 89, path + "max_angle_deg");
}

std::vector<std::pair<int, int>> FindCovisiblePairs(const PolygonModel& model,
                                                    const Visibility& visibility,
                                                    const std::vector<Camera>& cameras,
                                                    const CovisibleOptions& options) {
  std::vector<Eigen::Vector3d> normals_in_world;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    normals_in_world.push_back(ComputeFacePlane(model, face).normal_in_world);
  }
  std::vector<std::vector<SeenPlace>> places(cameras.size());
  tbb::parallel_for(size_t{0}, cameras.size(), [&](size_t i) {
    places[i] = PlacesSeenBy(cameras[i], visibility, normals_in_world, options);
  });
  std::vector<std::vector<std::pair<int, int>>> pairs_of(cameras.size());
  tbb::parallel_for(size_t{0}, cameras.size(), [&](size_t i) {
    for (size_t j = i + 1; j < cameras.size(); ++j) {
      if (ShareSeenBy(cameras[j], places[i], visibility, options) >= options.least_share ||
          ShareSeenBy(cameras[i], places[j], visibility, options) >= options.least_share) {
        pairs_of[i].emplace_back(static_cast<int>(i), static_cast<int>(j));
      }
    }
  });
  std::vector<std::pair<int, int>> pairs;
  for (const auto& own : pairs_of) pairs.insert(pairs.end(), own.begin(), own.end());
  return pairs;
}

}  // namespace groundglass
