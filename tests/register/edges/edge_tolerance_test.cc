// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_tolerance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

// Two upright walls, 20 and 4 wide, 10 high, that meet at the origin's upright edge and turn there
// by turn_deg. In metres.
PolygonModel TwoWalls(double turn_deg) {
  const double turn = turn_deg * M_PI / 180;
  const Eigen::Vector3d end(4 * std::cos(turn), 4 * std::sin(turn), 0);
  const Eigen::Vector3d up(0, 0, 10);
  PolygonModel model;
  model.unit = LengthUnit::kMetre;
  model.points_in_world = {{-20, 0, 0}, {0, 0, 0}, {0, 0, 10}, {-20, 0, 10}, end, end + up};
  model.faces = {{{0, 1, 2, 3}, "long"}, {{1, 4, 5, 2}, "short"}};
  return model;
}

// Of the crease, and of the edges on the ground.
std::pair<double, double> TolerancesOfCreaseAndGround(const PolygonModel& model) {
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  const std::vector<EdgeTolerance> tolerances = FindEdgeTolerances(model, edges);
  double crease = -1, ground = -1;
  for (size_t i = 0; i < edges.size(); ++i) {
    if (edges[i].kind == ModelEdge::Kind::kCrease) {
      crease = tolerances[i].sigma;
      EXPECT_FALSE(tolerances[i].on_ground);
    } else if (edges[i].start_in_world.z() == 0 && edges[i].end_in_world.z() == 0) {
      ground = tolerances[i].sigma;
      EXPECT_TRUE(tolerances[i].on_ground);
    } else {
      EXPECT_EQ(tolerances[i].sigma, 0);
      EXPECT_FALSE(tolerances[i].on_ground);
    }
  }
  return {crease, ground};
}

TEST(EdgeTolerance, AFacetMayBulgeByItsArcsSagitta) {
  // Chord 4, turn 5 degrees: radius 2 / sin(2.5 deg) = 45.85, sagitta 45.85 (1 - cos 2.5 deg).
  const double sagitta = 2 / std::sin(2.5 * M_PI / 180) * (1 - std::cos(2.5 * M_PI / 180));
  const auto [crease, ground] = TolerancesOfCreaseAndGround(TwoWalls(5));
  EXPECT_NEAR(crease, sagitta, 1e-9);
  EXPECT_NEAR(sagitta, 0.0436, 1e-4);
  EXPECT_NEAR(ground, 0.07, 1e-12);
}

TEST(EdgeTolerance, WideFacetsAreCapped) {
  EXPECT_NEAR(TolerancesOfCreaseAndGround(TwoWalls(30)).first, 0.1, 1e-12);
}

TEST(EdgeTolerance, ACornerIsMeantAsItIsDrawn) {
  EXPECT_EQ(TolerancesOfCreaseAndGround(TwoWalls(60)).first, 0);
  EXPECT_EQ(TolerancesOfCreaseAndGround(TwoWalls(90)).first, 0);
}

TEST(EdgeTolerance, ScalesWithTheUnit) {
  PolygonModel model = TwoWalls(60);
  model.unit = LengthUnit::kFoot;
  // As good as a building's; by default it would be a smaller thing's, being a third as large.
  model.sigma = 0.03 / 0.3048;
  EXPECT_NEAR(TolerancesOfCreaseAndGround(model).second, 0.07 / 0.3048, 1e-9);
}

}  // namespace
}  // namespace groundglass
