// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "exchange/exchange_scene.h"

#include <Eigen/Dense>

namespace groundglass {

// A place on Earth, WGS 84; the height above the datum of the model's origin.
struct GeodeticPlace {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;
};
// The inverse of SiteFromGeodetic (scene/formats/tags_csv.h), to a tenth of a millimetre within
// 100 km of the origin. The scene must have a georeference.
GeodeticPlace PlaceOnEarth(const ExchangeScene& scene, const Eigen::Vector3d& point_in_world);

// The bearing of a direction, clockwise from true north, 0 to 360; and its height above level.
double TrueBearingDeg(const ExchangeScene& scene, const Eigen::Vector3d& direction_in_world);
double ElevationDeg(const Eigen::Vector3d& direction_in_world);

// Error naming `out` if the scene does not say where on Earth it is.
void NeedGeoreference(const ExchangeScene& scene, const std::filesystem::path& out);

}  // namespace groundglass
