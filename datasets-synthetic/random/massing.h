// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/material.h"
#include "datasets-synthetic/random/traits.h"

#include <Eigen/Dense>

#include <cstdint>
#include <string>
#include <vector>

namespace groundglass {

// A building as its parts, before there are polygons: the photographed world and the model that
// people get are both made from it. Feet, in the plan's own frame: x along the street, y away from
// it, z up; the street lies at negative y.

// A window, a door or a shop front in a wall; s runs along the wall from its corner, z is a height.
struct Opening {
  double start_s = 0;
  double end_s = 0;
  double low_z = 0;
  double high_z = 0;
  bool is_arched = false;  // its top is half an ellipse, part of its height
  bool is_door = false;
  int num_panes = 1;
};

// A corner of a plan and the wall from there to the next.
struct PlanCorner {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double radius = 0;     // rounded, if above 0
  bool has_wall = true;  // no: another body stands there
  std::vector<Opening> openings;
};

enum class RoofKind { kFlat, kGabled, kHipped, kMono };

// An upright body with its roof. Plans other than rectangles have flat roofs.
struct Body {
  std::string name;
  std::vector<PlanCorner> plan;   // counterclockwise seen from above
  std::vector<PlanCorner> court;  // clockwise; empty if there is none
  double base = 0;
  double eaves = 10;  // where the roof begins
  RoofKind roof = RoofKind::kFlat;
  double parapet = 0;            // above the eaves of a flat roof
  double ridge = 10;             // height of a pitched roof
  bool is_ridge_along_x = true;  // of a mono-pitch roof: it rises along y, else along x
  double overhang = 0;
  int runs_into = -1;  // the body into whose slope at the street, or at the back, its roof runs
  Material material = Material::kBrick;
  Rgb color = Rgb(0.3f, 0.12f, 0.08f);
  Material roof_material = Material::kRoof;
  Rgb roof_color = Rgb(0.3f, 0.29f, 0.27f);
  double cornice = 0;
  std::vector<double> course_heights;
  bool has_plinth = false;
  bool is_neighbour = false;

  Eigen::Vector2d Low() const;
  Eigen::Vector2d High() const;
  // The top of its walls, or of its roof.
  double Top() const { return roof == RoofKind::kFlat ? eaves + parapet : ridge; }
};

// Something box-shaped: a chimney, a step, a post of the porch.
struct PlainBox {
  std::string kind;  // chimneys, steps, porch
  std::string name;
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  Material material = Material::kStone;
  Rgb color = Rgb(0.4f, 0.38f, 0.33f);
};

// A gabled window on the slope of the first body that faces the street.
struct Dormer {
  double center_x = 0;
  double width = 6;
  double front_y = 3;  // of its wall
  double eaves = 30;
  double ridge = 33;
};

struct Massing {
  std::vector<Body> bodies;  // neighbours last
  std::vector<PlainBox> boxes;
  std::vector<Dormer> dormers;
  // What the entrance needs: the middle of the door on the street's wall.
  double door_x = 0;
};

// Where the slope towards the street of a body with its ridge along x lies over a place.
double StreetSlopeAt(const Body& body, double y);

// Bodies, chimneys, dormers and neighbours; walls have no openings yet.
Massing DrawMassing(const RandomTraits& traits, uint64_t seed);

// Windows, and a door with its steps and porch.
void LayOutOpenings(const RandomTraits& traits, uint64_t seed, Massing& massing);

}  // namespace groundglass
