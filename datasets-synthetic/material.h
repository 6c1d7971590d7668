// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

namespace groundglass {

using Rgb = Eigen::Vector3f;  // linear light

// What a surface is made of. Each is a procedural texture in feet, detailed from the building down
// to a hand's breadth, and filtered over the pixel's footprint so that it never aliases.
enum class Material {
  kTile,        // white tiles on a 5 ft grid with dark joints, streaks, vents, replaced tiles
  kWindowBand,  // panes with mullions and blinds
  kStorefront,  // doors and glazing from the floor up
  kConcrete,    // board-marked, with form ties
  kRoof,        // gravel
  kPaving,      // plaza pavers
  kGrass,
  kAsphalt,
  kFacade,   // a distant building's wall with its windows
  kBrick,    // running bond, with headers of another colour
  kStone,    // ashlar trim
  kPlaster,  // rendered walls
  kSlate,    // roof slates in courses
  kPlain,    // paint or metal
  kFoliage,
  kBark,
  kPaint,  // of a car: it mirrors a little
  kGlass,  // dark, and mirrors
  kEven,   // one colour
  kPanel,  // one even colour, with soft blotches that fade out before the border of a rectangle
};

// A picture stuck on a wall: lettering, a poster. Transparent where alpha is 0.
struct Decal {
  double low_u = 0, low_v = 0, high_u = 1, high_v = 1;  // feet, on the surface
  // Running sums over rows and columns of premultiplied linear colour and alpha, so that the mean
  // over any rectangle costs four look-ups (Crow 1984): (width + 1) x (height + 1) x 4.
  Raster<double> sums;
};
// Makes the sums from a picture of linear colour and alpha (4 channels, first row on top).
Decal MakeDecal(const ImageF& rgba, double low_u, double low_v, double high_u, double high_v);

// One face as it looks: its material, and the frame its texture lies in.
struct Surface {
  Material material = Material::kPlain;
  Rgb color = Rgb(0.7f, 0.7f, 0.7f);
  uint64_t seed = 0;
  // Texture coordinates in feet: u = axis_u . point + offset_u, v likewise; v is up on walls.
  Eigen::Vector3d axis_u = Eigen::Vector3d::UnitX();
  Eigen::Vector3d axis_v = Eigen::Vector3d::UnitZ();
  double offset_u = 0;
  double offset_v = 0;
  // The face's extent.
  double low_v = 0;
  double high_v = 0;
  double low_u = 0;
  double high_u = 0;
  // The v of the coping that rain streaks run from: the face's top, or that of its whole wall.
  double coping_v = 0;
  std::vector<Decal> decals;
  int mask_code = 0;  // for things that are not in the model and stand in the way; else 0
  // Part of the building that lies elsewhere than the model says, or is not in it: a deep window,
  // its reveals and sill, a corner that is really round.
  bool is_relief = false;

  Eigen::Vector2d TextureOf(const Eigen::Vector3d& point_in_world) const {
    return {axis_u.dot(point_in_world) + offset_u, axis_v.dot(point_in_world) + offset_v};
  }
};

// What a surface shows at a place.
struct Appearance {
  Rgb albedo = Rgb::Zero();
  float gloss = 0;  // share that mirrors the sky, as glass does
};

// The mean appearance over a footprint (feet, in u and v) about a place.
Appearance AppearanceAt(const Surface& surface, double u, double v, double width_u, double width_v);

}  // namespace groundglass
