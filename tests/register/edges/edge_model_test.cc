// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_samples.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(EdgeModel, AGroundFarBeyondTheBuildingHasNoEdges) {
  PolygonModel model;
  model.unit = LengthUnit::kMetre;
  model.points_in_world = {
      {0, 0, 0}, {9, 0, 0}, {9, 7, 0}, {0, 7, 0}, {0, 0, 5}, {9, 0, 5}, {9, 7, 5}, {0, 7, 5}};
  model.faces = {{{0, 1, 5, 4}, ""},
                 {{1, 2, 6, 5}, ""},
                 {{2, 3, 7, 6}, ""},
                 {{3, 0, 4, 7}, ""},
                 {{4, 5, 6, 7}, ""}};
  const EdgeModel alone(model);
  ASSERT_EQ(alone.edges.size(), 12u);
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(-1, -1),
                                        Eigen::Vector2d(1, -1),
                                        Eigen::Vector2d(1, 1),
                                        Eigen::Vector2d(-1, 1)}) {
    model.points_in_world.emplace_back(5000 * corner.x(), 5000 * corner.y(), -0.2);
  }
  model.faces.push_back({{8, 9, 10, 11}, "terrain"});
  const EdgeModel on_terrain(model);
  EXPECT_EQ(on_terrain.edges.size(), 12u);
  EXPECT_EQ(on_terrain.sigma, alone.sigma);
  int num_on_ground = 0;
  for (const EdgeTolerance& tolerance : on_terrain.tolerances) num_on_ground += tolerance.on_ground;
  EXPECT_EQ(num_on_ground, 4) << "the walls' feet";
}

}  // namespace
}  // namespace groundglass
