// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/photograph_place.h"

#include "scene/check_option.h"
#include "scene/formats/tags_csv.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <array>
#include <cmath>

namespace groundglass {
namespace {

// A mistake is named if what mends it brings the photograph at least this much nearer.
constexpr double kMendsByFactor = 20;
// Heights in feet: as given far from the origin's, and near to it once they are turned to metres.
constexpr double kFarHeight_m = 80;
constexpr double kNearHeight_m = 40;

std::string FormatDistance(double metres) {
  return metres < 10000 ? FormatNumber(std::round(metres)) + " m"
                        : FormatNumber(std::round(metres / 1000)) + " km";
}

// From the model's origin, over the ground; metres. Straight through the Earth for far places.
double DistanceFromOrigin(const PolygonModel& model, double latitude_deg, double longitude_deg) {
  return MetresPerUnit(model.unit) *
         SiteFromGeodetic(model, latitude_deg, longitude_deg, model.georeference->height_m).norm();
}

// Why a position cannot be meant, with what it would be without a usual mistake; empty if it can.
std::string FindPositionFault(const GpsFix& fix,
                              const PolygonModel& model,
                              const PlaceOptions& options) {
  const double distance = DistanceFromOrigin(model, fix.latitude_deg, fix.longitude_deg);
  if (distance <= options.farthest_m) return "";
  std::string fault = "GPS position lies " + FormatDistance(distance) + " from the model's origin";
  struct Mistake {
    const char* words;
    double latitude_deg, longitude_deg;
  };
  const std::array<Mistake, 3> mistakes = {
      {{"with east and west exchanged", fix.latitude_deg, -fix.longitude_deg},
       {"with north and south exchanged", -fix.latitude_deg, fix.longitude_deg},
       {"with latitude and longitude exchanged", fix.longitude_deg, fix.latitude_deg}}};
  for (const Mistake& mistake : mistakes) {
    if (std::abs(mistake.latitude_deg) > 90) continue;
    const double mended = DistanceFromOrigin(model, mistake.latitude_deg, mistake.longitude_deg);
    if (mended > options.farthest_m || mended * kMendsByFactor > distance) continue;
    return fault + "; " + mistake.words + " it would be " + FormatDistance(mended);
  }
  return fault;
}

// The same of its height.
std::string FindHeightFault(double height_m, const Georeference& origin) {
  const double above = height_m - origin.height_m;
  const double above_if_feet = kMetresPerFoot * height_m - origin.height_m;
  if (std::abs(above) < kFarHeight_m || std::abs(above_if_feet) > kNearHeight_m) return "";
  return "GPS height of " + FormatNumber(height_m) + " lies " + FormatDistance(std::abs(above)) +
         (above > 0 ? " above" : " below") + " the model's origin in metres, and " +
         FormatDistance(std::abs(above_if_feet)) + " from it in feet: it seems to be in feet";
}

double HorizontalSigma(const GpsFix& fix, const PlaceOptions& options) {
  if (fix.horizontal_sigma_m) return *fix.horizontal_sigma_m;
  return fix.dilution ? *fix.dilution * options.per_dilution_m : options.position_m;
}

struct Bearing {
  double from_true_north_deg = 0;
  double sigma_deg = 0;
};

std::optional<Bearing> FindBearing(const CompassAndLevel& direction, const PlaceOptions& options) {
  if (!direction.bearing_deg) return std::nullopt;
  Bearing bearing{*direction.bearing_deg, options.compass_deg};
  if (!direction.is_bearing_magnetic) return bearing;
  bearing.from_true_north_deg += options.declination_deg.value_or(0);
  if (!options.declination_deg) {
    bearing.sigma_deg = std::hypot(bearing.sigma_deg, options.declination_sigma_deg);
  }
  return bearing;
}

void AddPoint(KnownKeys& keys, const std::array<const char*, 3>& names, const Eigen::Vector3d& p) {
  for (int i = 0; i < 3; ++i) AddKnown(keys, names[static_cast<size_t>(i)], p[i]);
}

// The look-at point along the compass' direction, as far away as the model's middle.
void AddDirection(const Eigen::Vector3d& position_in_site,
                  const Bearing& bearing,
                  const CompassAndLevel& direction,
                  const PolygonModel& model,
                  const PlaceOptions& options,
                  PhotographPlace& place) {
  const Eigen::Vector3d middle = SiteFromWorld(ComputeBounds(model).Center());
  const double distance = std::max(1.0, (middle - position_in_site).norm());
  const double yaw =
      RadiansFromDegrees(bearing.from_true_north_deg - model.georeference->north_deg);
  const double pitch = RadiansFromDegrees(direction.pitch_deg.value_or(0));
  const Eigen::Vector3d axis_in_world(
      std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch), std::sin(pitch));
  AddPoint(place.keys, {"i", "j", "k"}, position_in_site + distance * SiteFromWorld(axis_in_world));
  const double sigma_deg = std::max(
      bearing.sigma_deg, direction.pitch_deg ? options.level_deg : options.level_if_unknown_deg);
  AddKnown(place.keys,
           "sigma_lookat",
           distance * RadiansFromDegrees(sigma_deg),
           direction.source + (direction.pitch_deg ? "" : "; pitch not known, taken for level"));
}

}  // namespace

void PlaceOptions::Check() const {
  CheckAbove(per_dilution_m, 0, "place options: per_dilution_m");
  CheckAbove(position_m, 0, "place options: position_m");
  CheckAbove(height_factor, 0, "place options: height_factor");
  CheckAbove(height_m, 0, "place options: height_m");
  CheckAbove(compass_deg, 0, "place options: compass_deg");
  CheckAtLeast(declination_sigma_deg, 0, "place options: declination_sigma_deg");
  CheckAbove(level_deg, 0, "place options: level_deg");
  CheckAbove(level_if_unknown_deg, 0, "place options: level_if_unknown_deg");
  if (declination_deg) CheckFromTo(*declination_deg, -180, 180, "declination");
  CheckFromTo(geoid_m, -120, 120, "geoid");
  CheckAbove(farthest_m, 0, "place options: farthest_m");
}

PhotographPlace FindPhotographPlace(const PhotographMetadata& metadata,
                                    const PolygonModel& model,
                                    const PlaceOptions& options) {
  options.Check();
  PhotographPlace place;
  const CompassAndLevel& direction = metadata.direction;
  if (direction.roll_deg) {
    AddKnown(place.keys, "roll", *direction.roll_deg);
    AddKnown(place.keys, "sigma_roll", options.level_deg);
  }
  if (!metadata.gps) return place;
  const GpsFix& fix = *metadata.gps;
  if (!model.georeference) {
    place.faults.push_back(
        "GPS position, since the model does not say where it stands (a comment '% origin: "
        "LATITUDE LONGITUDE HEIGHT' in it)");
    return place;
  }
  std::string fault = FindPositionFault(fix, model, options);
  if (fault.empty() && !fix.height_m) fault = "GPS position without a height";
  const double height_m = fix.height_m.value_or(0) + options.geoid_m;
  if (fault.empty()) fault = FindHeightFault(height_m, *model.georeference);
  if (!fault.empty()) {
    place.faults.push_back(fault);
    return place;
  }
  const Eigen::Vector3d position =
      SiteFromGeodetic(model, fix.latitude_deg, fix.longitude_deg, height_m);
  const double units_per_metre = 1 / MetresPerUnit(model.unit);
  const double sigma_m = HorizontalSigma(fix, options);
  AddPoint(place.keys, {"x", "y", "z"}, position);
  AddKnown(place.keys, "sigma_position", units_per_metre * sigma_m, "GPS");
  AddKnown(place.keys,
           "sigma_height",
           units_per_metre * std::max(options.height_m, options.height_factor * sigma_m));
  if (const std::optional<Bearing> bearing = FindBearing(direction, options)) {
    AddDirection(position, *bearing, direction, model, options, place);
  }
  return place;
}

}  // namespace groundglass
