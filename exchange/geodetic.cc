// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/geodetic.h"

#include "scene/error.h"
#include "scene/formats/tags_csv.h"
#include "scene/frames.h"

#include <cmath>

namespace groundglass {

GeodeticPlace PlaceOnEarth(const ExchangeScene& scene, const Eigen::Vector3d& point_in_world) {
  PolygonModel model;
  model.unit = scene.unit;
  model.georeference = scene.georeference;
  const Georeference& origin = *scene.georeference;
  const double metres = MetresPerUnit(scene.unit);
  GeodeticPlace place = {origin.latitude_deg, origin.longitude_deg, origin.height_m};
  // Newton's method with the sphere's derivative, which is right to half a per cent: each step
  // gains two digits.
  constexpr double kMetresPerDegree = 111320;
  const double north = RadiansFromDegrees(origin.north_deg);
  for (int step = 0; step < 12; ++step) {
    const Eigen::Vector3d found = WorldFromSite(
        SiteFromGeodetic(model, place.latitude_deg, place.longitude_deg, place.height_m));
    const Eigen::Vector3d missing_m = (point_in_world - found) * metres;
    // To true east and north.
    const double east_m = std::cos(north) * missing_m.x() + std::sin(north) * missing_m.y();
    const double north_m = -std::sin(north) * missing_m.x() + std::cos(north) * missing_m.y();
    place.latitude_deg += north_m / kMetresPerDegree;
    place.longitude_deg +=
        east_m / (kMetresPerDegree * std::cos(RadiansFromDegrees(place.latitude_deg)));
    place.height_m += missing_m.z();
  }
  return place;
}

double TrueBearingDeg(const ExchangeScene& scene, const Eigen::Vector3d& direction_in_world) {
  const double in_model_deg =
      DegreesFromRadians(std::atan2(direction_in_world.x(), direction_in_world.y()));
  const double north_deg = scene.georeference ? scene.georeference->north_deg : 0;
  return std::fmod(in_model_deg + north_deg + 720, 360);
}

double ElevationDeg(const Eigen::Vector3d& direction_in_world) {
  return DegreesFromRadians(std::asin(direction_in_world.normalized().z()));
}

void NeedGeoreference(const ExchangeScene& scene, const std::filesystem::path& out) {
  if (scene.georeference) return;
  throw Error(out,
              "the model does not say where on Earth it is; give it a comment '% origin: LATITUDE "
              "LONGITUDE HEIGHT' and '% north: DEGREES'");
}

}  // namespace groundglass
