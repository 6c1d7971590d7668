// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/model_flaw.h"
#include "datasets-synthetic/synthetic_world.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// Where a photographer stands and looks: the notebook's numbers, in `site`, in the model's unit.
struct PlannedView {
  std::string name;
  Eigen::Vector3d position_in_site = Eigen::Vector3d::Zero();
  Eigen::Vector3d lookat_in_site = Eigen::Vector3d::Zero();
  double view_angle_deg = 58;
  std::string comment;
};

// A building with its surroundings, and the views that show it.
struct Subject {
  SyntheticWorld world;
  std::vector<PlannedView> views;
  std::vector<PlannedView> novel_views;

  // What people get where it is not the world's first faces, the same without its errors, and where
  // these are large.
  struct DrawnModel {
    PolygonModel model;
    PolygonModel exact_model;
    std::vector<ModelFlaw> flaws;
  };
  std::optional<DrawnModel> drawn_model;
  // What is built there, neighbours too; where nothing is said, the model's own extent.
  std::optional<Box> built;
};

// A white tiled modernist block after the Wiesner Building as the thesis describes it: setbacks, an
// arcade, an entrance recess, window bands, rounded corners of three flat faces a quarter; 23 views
// with the thesis' s5 among them. Feet; about 100 faces.
Subject MakeWiesner(uint64_t seed);

// A brick hall with a cross wing under slate gables, stone base, string course and quoins, a porch
// and a chimney; about 70 faces, windows among them.
Subject MakeBrickHall(uint64_t seed);

// Six buildings of a city block, their windows in the model: about `num_faces` faces in all (300 to
// 30,000).
Subject MakeCityBlock(uint64_t seed, int num_faces);

// Views from around a building, all with the same view angle: `count` on an ellipse that is
// `distance` away from the bounds on the ground, each looking at the near side.
std::vector<PlannedView> MakeRingOfViews(const Box& bounds_in_world,
                                         int count,
                                         double distance,
                                         double start_deg,
                                         double eye_height,
                                         const std::string& prefix,
                                         int first_number);

// Height of the lawn about the plaza, feet.
constexpr double kLawnHeight = -0.6;
constexpr const char* kPlazaName = "plaza";

// The ground, roads and distant blocks around a building that stands within `radius` feet of
// `center_in_world`; called after the building's own faces.
void AddSurroundings(WorldBuilder& builder,
                     const Eigen::Vector2d& center_in_world,
                     double radius,
                     uint64_t seed);

}  // namespace groundglass
