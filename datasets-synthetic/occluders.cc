// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/occluders.h"

#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/occluder_shapes.h"

#include <cmath>

namespace groundglass {
namespace {

bool IsFree(const OccluderSite& site, const Eigen::Vector2d& place, double clearance) {
  const Eigen::Vector2d nearest = place.cwiseMax(site.low).cwiseMin(site.high);
  if ((place - nearest).norm() < clearance) return false;
  for (const Eigen::Vector3d& camera : site.camera_positions) {
    if ((place - camera.head<2>()).norm() < 22) return false;
  }
  return true;
}

Eigen::Vector3d OnGround(const OccluderSite& site, const Eigen::Vector2d& place) {
  const bool is_on_plaza = (place.array() > site.plaza_low.array()).all() &&
                           (place.array() < site.plaza_high.array()).all();
  return {place.x(), place.y(), is_on_plaza ? 0 : kLawnHeight};
}

// A free place around the building, between `low` and `high` of the plaza's radius from its centre.
Eigen::Vector2d PlaceAround(const OccluderSite& site, Draws& draws, double low, double high) {
  const Eigen::Vector2d center = (site.low + site.high) / 2;
  Eigen::Vector2d place = center;
  for (int attempt = 0; attempt < 60; ++attempt) {
    const double angle = draws.Angle();
    place = center + site.radius * draws.Uniform(low, high) *
                         Eigen::Vector2d(std::cos(angle), std::sin(angle));
    if (IsFree(site, place, 22)) break;
  }
  return place;
}

}  // namespace

const std::vector<std::pair<int, std::string>>& OccluderNames() {
  static const std::vector<std::pair<int, std::string>> names = {{kPerson, "person"},
                                                                 {kTree, "tree"},
                                                                 {kSign, "sign"},
                                                                 {kLamp, "lamp"},
                                                                 {kCar, "car"},
                                                                 {kMount, "slide mount"}};
  return names;
}

void AddStandingOccluders(WorldBuilder& builder,
                          const OccluderSite& site,
                          const OccluderCounts& counts,
                          uint64_t seed) {
  const Eigen::Vector2d center = (site.low + site.high) / 2;
  Draws draws(SeedFor(seed, "standing"));
  for (int i = 0; i < counts.trees; ++i) {
    AddTree(builder, PlaceAround(site, draws, 0.72, 1.05), SeedFor(seed, "tree", i));
  }
  for (int i = 0; i < counts.lamps; ++i) AddLamp(builder, PlaceAround(site, draws, 0.6, 0.95));
  for (int i = 0; i < counts.signs; ++i) {
    const Eigen::Vector2d place = PlaceAround(site, draws, 0.75, 0.95);
    AddSign(builder, place, 2 * place - center, i);
  }
}

void AddPassingOccluders(WorldBuilder& builder,
                         const OccluderSite& site,
                         const Eigen::Vector3d& camera_position,
                         const Eigen::Vector3d& camera_forward,
                         const OccluderCounts& counts,
                         uint64_t seed) {
  Draws draws(SeedFor(seed, "passing"));
  const Eigen::Vector2d ahead = camera_forward.head<2>().normalized();
  const Eigen::Vector2d aside(-ahead.y(), ahead.x());
  const auto place_before_camera = [&](double near, double far) {
    Eigen::Vector2d place = camera_position.head<2>();
    for (int attempt = 0; attempt < 40; ++attempt) {
      const double distance = draws.Uniform(near, far);
      place = camera_position.head<2>() + distance * (ahead + draws.Uniform(-0.5, 0.5) * aside);
      if (IsFree(site, place, 6)) return std::make_pair(place, true);
    }
    return std::make_pair(place, false);
  };
  const int num_cars = draws.Count(counts.cars);
  const int num_people = draws.Count(counts.people);
  for (int i = 0; i < num_cars; ++i) {
    const auto [place, is_free] = place_before_camera(50, 150);
    if (is_free) AddCar(builder, OnGround(site, place), SeedFor(seed, "car", i));
  }
  for (int i = 0; i < num_people; ++i) {
    const auto [place, is_free] = place_before_camera(45, 160);
    if (is_free) AddPerson(builder, OnGround(site, place), SeedFor(seed, "person", i));
  }
}

}  // namespace groundglass
