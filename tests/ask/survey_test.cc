// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/survey.h"

#include "tests/ask/room_survey.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

PolygonModel Scaled(PolygonModel model, double factor) {
  for (Eigen::Vector3d& point : model.points_in_world) point *= factor;
  return model;
}

TEST(IsSameModel, TellsAnotherUnitAndAnotherBuilding) {
  const PolygonModel room = MakeWallSurvey().model;
  EXPECT_TRUE(IsSameModel(room, room));
  EXPECT_TRUE(IsSameModel(room, Scaled(room, 1.001)));
  EXPECT_FALSE(IsSameModel(room, Scaled(room, 0.3048)));
  PolygonModel fewer = room;
  fewer.faces.pop_back();
  EXPECT_FALSE(IsSameModel(room, fewer));
  EXPECT_FALSE(IsSameModel({}, {}));
}

}  // namespace
}  // namespace groundglass
