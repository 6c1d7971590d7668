// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/random/plan_frame.h"

namespace groundglass {

// A building as its photographers find it.
struct StationSite {
  const SyntheticWorld& world;
  int num_own_faces = 0;  // the building's, the first ones of the world
  const Massing& massing;
  PlanFrame frame;
  const RandomTraits& traits;
  double aspect = 1.5;  // of the frame
  uint64_t seed = 0;
};

// Stations around the building, mostly at the street: whole views, oblique ones, some close to a
// part of it, some from a window across the street. None is inside a body or close before a wall,
// and each sees the building. Named after `prefix`, "s1" and on.
std::vector<PlannedView> DrawStations(const StationSite& site,
                                      int count,
                                      const std::string& prefix);

}  // namespace groundglass
