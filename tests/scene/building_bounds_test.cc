// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/building_bounds.h"

#include "scene/model_sigma.h"
#include "scene/visibility.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

// Four walls and a roof, 12 x 8 x 6 m.
PolygonModel House() {
  PolygonModel house;
  house.unit = LengthUnit::kMetre;
  house.points_in_world = {
      {0, 0, 0}, {12, 0, 0}, {12, 8, 0}, {0, 8, 0}, {0, 0, 6}, {12, 0, 6}, {12, 8, 6}, {0, 8, 6}};
  house.faces = {{{0, 1, 5, 4}, ""},
                 {{1, 2, 6, 5}, ""},
                 {{2, 3, 7, 6}, ""},
                 {{3, 0, 4, 7}, ""},
                 {{4, 5, 6, 7}, "roof"}};
  return house;
}

void AddQuad(const Eigen::Vector3d& corner,
             const Eigen::Vector3d& along,
             const Eigen::Vector3d& up,
             PolygonModel& model) {
  const int first = static_cast<int>(model.points_in_world.size());
  for (const Eigen::Vector3d& point : {corner,
                                       Eigen::Vector3d(corner + along),
                                       Eigen::Vector3d(corner + along + up),
                                       Eigen::Vector3d(corner + up)}) {
    model.points_in_world.push_back(point);
  }
  model.faces.push_back({{first, first + 1, first + 2, first + 3}, ""});
}

TEST(BuildingBounds, AreThoseOfAModelWithoutTerrain) {
  PolygonModel model = House();
  EXPECT_EQ(ComputeBuildingBounds(model).max, Eigen::Vector3d(12, 8, 6));
  AddQuad({-20, -20, 0}, {60, 0, 0}, {0, 60, 0}, model);  // its yard
  EXPECT_EQ(ComputeBuildingBounds(model).max, Eigen::Vector3d(40, 40, 6));
}

TEST(BuildingBounds, LeaveOutAGroundThatDwarfsTheRest) {
  PolygonModel model = House();
  AddQuad({-9000, -9000, -1}, {20000, 0, 40}, {0, 20000, 90}, model);
  AddQuad({-9000, -29000, -1}, {20000, 0, 40}, {0, 20000, 0}, model);
  const Box bounds = ComputeBuildingBounds(model);
  EXPECT_EQ(bounds.min, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(bounds.max, Eigen::Vector3d(12, 8, 6));
  // What is known of it does not suffer either.
  EXPECT_EQ(DefaultModelSigma(model), DefaultModelSigma(House()));
  EXPECT_EQ(Visibility(model).DefaultTolerance(), Visibility(House()).DefaultTolerance());
}

TEST(BuildingBounds, KeepLongWallsWithSmallThingsOnThem) {
  PolygonModel model = House();  // a kiosk, beside a dam
  AddQuad({0, 20, 0}, {900, 0, 0}, {0, 0, 80}, model);
  EXPECT_EQ(ComputeBuildingBounds(model).max, Eigen::Vector3d(900, 20, 80));
}

}  // namespace
}  // namespace groundglass
