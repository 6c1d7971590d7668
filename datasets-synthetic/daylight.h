// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/synthetic_world.h"
#include "scene/visibility.h"

#include <vector>

namespace groundglass {

// The sky and the sun over one photograph, in linear light scaled so that a white wall comes out
// well exposed.
struct Daylight {
  bool is_sunny = false;
  Eigen::Vector3d to_sun = Eigen::Vector3d::UnitZ();  // unit, in `world`
  Rgb sun = Rgb::Zero();      // irradiance of a surface that faces the sun, over pi
  Rgb sky = Rgb(1, 1, 1);     // irradiance of a surface that sees the whole sky, over pi
  Rgb zenith = Rgb(1, 1, 1);  // radiance as seen
  Rgb horizon = Rgb(1, 1, 1);
  double cloud_cover = 1;  // 0: a clear or an even sky
  uint64_t seed = 0;
};

Daylight MakeOvercast(uint64_t seed);
// Azimuth clockwise from the site's north.
Daylight MakeSunny(double azimuth_deg, double elevation_deg, uint64_t seed);

// Radiance of the sky in a direction (unit, in `world`), clouds included.
Rgb SkyRadiance(const Daylight& light, const Eigen::Vector3d& direction_in_world);

// What reaches a place that sees this share of the sky, without the sun itself: the sky's light,
// and for the rest what ground and walls send back of theirs.
Rgb IndirectIrradiance(const Daylight& light, float sky_share);

// How much of the sky each place on each face sees, cosine-weighted: 1 on open ground, a half on a
// wall that stands free. Sampled on a grid of a few feet over each face near the building, and read
// between its points.
class SkyMap {
 public:
  // Faces that reach further than `radius` from `center_in_world` are taken as open.
  SkyMap(const SyntheticWorld& world,
         const Visibility& visibility,
         const Eigen::Vector3d& center_in_world,
         double radius);

  double SkyShare(const Surface& surface, int face, double u, double v) const;

 private:
  struct Grid {
    double low_u = 0, low_v = 0, step = 1;
    int columns = 0, rows = 0;
    std::vector<float> shares;  // empty: `open` everywhere
    float open = 1;
  };
  std::vector<Grid> grids_;
};

}  // namespace groundglass
