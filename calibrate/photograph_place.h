// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/known_keys.h"
#include "scene/formats/photograph_metadata.h"
#include "scene/polygon_model.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// How far what a receiver, a compass and a level say may lie off, one standard deviation.
struct PlaceOptions {
  // Across, where the photograph does not state it: so much for each unit of its dilution of
  // precision, else the second.
  double per_dilution_m = 5;
  double position_m = 10;
  // A height is so many times worse than the position across, and never better than the second,
  // since some heights are above the ellipsoid that are said to be above the sea.
  double height_factor = 2;
  double height_m = 10;
  double compass_deg = 10;
  // Added to a compass that counts from magnetic north, unless the declination is given.
  double declination_sigma_deg = 10;
  double level_deg = 2;
  // Of the pitch where nothing tells it, so that the view is taken for level.
  double level_if_unknown_deg = 15;

  // Magnetic north, clockwise from true north, degrees.
  std::optional<double> declination_deg;
  // The sea's level above the ellipsoid at the model (the geoid's undulation), where the model's
  // origin is above the ellipsoid: added to the photographs' heights. Metres.
  double geoid_m = 0;
  // Farther than this from the model's origin a position is a mistake. Metres.
  double farthest_m = 5000;

  void Check() const;  // throws Error naming the first field out of range
};

// What a photograph's metadata say of its place, as keys of a view file in the model's frame.
struct PhotographPlace {
  KnownKeys keys;  // x y z, i j k, roll and their sigmas, as far as they are known
  // What is left out, and why: "GPS position lies 9000 km from the model's origin; with its
  // longitude west ...".
  std::vector<std::string> faults;
};

// The look-at point is put as far away as the model's middle. Heights count from the same zero as
// the model's origin (after geoid_m).
PhotographPlace FindPhotographPlace(const PhotographMetadata& metadata,
                                    const PolygonModel& model,
                                    const PlaceOptions& options = {});

}  // namespace groundglass
