// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/plan/suggest_viewpoint.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

void AddPlainFace(PolygonModel& model, const std::vector<Eigen::Vector3d>& corners) {
  Face face;
  for (const Eigen::Vector3d& corner : corners) {
    face.points.push_back(static_cast<int>(model.points_in_world.size()));
    model.points_in_world.push_back(corner);
  }
  model.faces.push_back(face);
}

// A wall of 40 x 20 ft that looks north, its foot on the ground.
PolygonModel Wall() {
  PolygonModel model;
  AddPlainFace(model, {{20, 0, 0}, {-20, 0, 0}, {-20, 0, 20}, {20, 0, 20}});
  return model;
}

// The same with a closed shed against it, 60 ft deep: most of the wall is indoors.
PolygonModel WallBehindAShed() {
  PolygonModel model = Wall();
  AddPlainFace(model, {{18, 60, 0}, {-18, 60, 0}, {-18, 60, 15}, {18, 60, 15}});
  AddPlainFace(model, {{18, 0, 0}, {18, 60, 0}, {18, 60, 15}, {18, 0, 15}});
  AddPlainFace(model, {{-18, 60, 0}, {-18, 0, 0}, {-18, 0, 15}, {-18, 60, 15}});
  AddPlainFace(model, {{18, 0, 15}, {18, 60, 15}, {-18, 60, 15}, {-18, 0, 15}});
  return model;
}

TEST(SuggestViewpoint, StandsSquareBeforeTheFaceAtEyeLevel) {
  const PolygonModel model = Wall();
  const auto stand = SuggestViewpoint(model, Visibility(model), 0, {0, 0, 10});
  ASSERT_TRUE(stand);
  EXPECT_NEAR(stand->x(), 0, 1e-9);
  EXPECT_GT(stand->y(), 10);
  EXPECT_NEAR(stand->z(), 5.5, 1e-9);
}

TEST(SuggestViewpoint, NobodyIsSentIndoors) {
  const PolygonModel model = WallBehindAShed();
  ASSERT_TRUE(Visibility(model).IsClear({0, 20, 5.5}, {0, 0, 5}, 0.01));
  EXPECT_FALSE(SuggestViewpoint(model, Visibility(model), 0, {0, 0, 5}));
  // What of the wall rises above the shed is seen from outdoors.
  const auto stand = SuggestViewpoint(model, Visibility(model), 0, {0, 0, 18});
  ASSERT_TRUE(stand);
  EXPECT_GT(stand->z(), 15);
}

// Four walls and no roof, and a screen within that faces one of them.
TEST(SuggestViewpoint, NobodyIsSentIntoACourtWithoutARoof) {
  PolygonModel model;
  AddPlainFace(model, {{0, 0, 0}, {60, 0, 0}, {60, 0, 30}, {0, 0, 30}});
  AddPlainFace(model, {{60, 0, 0}, {60, 60, 0}, {60, 60, 30}, {60, 0, 30}});
  AddPlainFace(model, {{60, 60, 0}, {0, 60, 0}, {0, 60, 30}, {60, 60, 30}});
  AddPlainFace(model, {{0, 60, 0}, {0, 0, 0}, {0, 0, 30}, {0, 60, 30}});
  AddPlainFace(model, {{25, 20, 0}, {35, 20, 0}, {35, 20, 10}, {25, 20, 10}});
  const Visibility visibility(model);
  ASSERT_FALSE(visibility.FirstHit({30, 10, 5.5}, Eigen::Vector3d::UnitZ()));
  EXPECT_FALSE(SuggestViewpoint(model, visibility, 4, {30, 20, 5}));
  // An outer wall is photographed from without.
  EXPECT_TRUE(SuggestViewpoint(model, visibility, 0, {30, 0, 15}));
}

}  // namespace
}  // namespace groundglass
