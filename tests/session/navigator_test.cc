// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/navigator.h"

#include "session/picking.h"
#include "tests/register/house.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

constexpr int kWindowWidth = 600;
constexpr int kWindowHeight = 400;

Eye EyeSouthOfHouse() {
  Eye eye;
  eye.position_in_world = {20, -50, 6};
  return eye;
}

Eigen::Vector2d ImageOf(const Eye& eye, const Eigen::Vector3d& point_in_world) {
  return *Project(eye.InFrame(kWindowWidth, kWindowHeight), point_in_world);
}

TEST(Navigator, OrbitKeepsThePointWhereItIsInThePicture) {
  const Eye eye = EyeSouthOfHouse();
  const Eigen::Vector3d about(35, 0, 12);
  const Eye turned = Orbit(eye, about, 80, -25);
  EXPECT_LT((ImageOf(turned, about) - ImageOf(eye, about)).norm(), 1e-6);
  EXPECT_GT((turned.position_in_world - eye.position_in_world).norm(), 5);
}

TEST(Navigator, PanLeavesWhatIsAtTheDepthUnderTheHand) {
  const Eye eye = EyeSouthOfHouse();
  const Eigen::Vector3d grabbed(22, 0, 9);
  const double depth = 50;  // along the view axis, which looks north
  const Eye moved = Pan(eye, depth, 30, -12, kWindowWidth);
  EXPECT_LT((ImageOf(moved, grabbed) - ImageOf(eye, grabbed) - Eigen::Vector2d(30, -12)).norm(),
            1e-6);
}

TEST(Navigator, DollyGoesTowardsThePointAndNeverThrough) {
  const Eye eye = EyeSouthOfHouse();
  const Eigen::Vector3d target(25, 0, 9);
  const Eye nearer = Dolly(eye, target, 40);
  EXPECT_LT((nearer.position_in_world - target).norm(), 0.2);
  EXPECT_LT((ImageOf(Dolly(eye, target, 3), target) - ImageOf(eye, target)).norm(), 1e-6);
  const Eye back = Dolly(Dolly(eye, target, 3), target, -3);
  EXPECT_LT((back.position_in_world - eye.position_in_world).norm(), 1e-9);
}

TEST(Navigator, AWalkerStaysOnTheGroundAndOutOfWalls) {
  const PolygonModel house = MakeHouse();
  const Visibility visibility(house);
  Eye eye = EyeSouthOfHouse();
  eye.position_in_world.z() = 30;
  // From the air down to the ground, then straight at the wall in the plane y = 0.
  for (int i = 0; i < 100; ++i) eye = Walk(eye, house, visibility, 2, 0);
  EXPECT_NEAR(eye.position_in_world.z(), 1.6 / 0.3048, 1e-9);
  EXPECT_LT(eye.position_in_world.y(), 0);
  EXPECT_GT(eye.position_in_world.y(), -12);
}

TEST(Navigator, StairsAreClimbedAndTablesAreNot) {
  PolygonModel model;
  model.unit = LengthUnit::kMetre;
  const auto add_step = [&](double y, double low, double high) {
    const int first = static_cast<int>(model.points_in_world.size());
    model.points_in_world.insert(model.points_in_world.end(),
                                 {{-2, y, low},
                                  {2, y, low},
                                  {2, y, high},
                                  {-2, y, high},
                                  {-2, y + 0.4, high},
                                  {2, y + 0.4, high}});
    model.faces.push_back({{first, first + 1, first + 2, first + 3}, "riser", 0});
    model.faces.push_back({{first + 3, first + 2, first + 5, first + 4}, "tread", 0});
  };
  for (int i = 0; i < 5; ++i) add_step(0.4 * i, 0.2 * i, 0.2 * (i + 1));
  const Visibility visibility(model);
  Eye eye;
  eye.position_in_world = {0, -1, 1.6};
  for (int i = 0; i < 16; ++i) eye = Walk(eye, model, visibility, 0.18, 0);
  EXPECT_NEAR(eye.position_in_world.z(), 1.0 + 1.6, 1e-6);
}

TEST(Navigator, TheFirstViewHoldsTheWholeModel) {
  const PolygonModel house = MakeHouse();
  const Camera camera = FirstEye(house, 1.5).InFrame(kWindowWidth, kWindowHeight);
  for (const Eigen::Vector3d& point : house.points_in_world) {
    EXPECT_TRUE(IsInsideFrame(camera, *Project(camera, point)));
  }
}

TEST(Navigator, AnEyeIsTheCameraItCameFromButForRoll) {
  const Camera camera = EyeSouthOfHouse().InFrame(kWindowWidth, kWindowHeight);
  const Eye eye = EyeOf(camera);
  EXPECT_LT((eye.position_in_world - EyeSouthOfHouse().position_in_world).norm(), 1e-9);
  EXPECT_NEAR(eye.yaw_deg, 90, 1e-9);
  EXPECT_NEAR(eye.view_angle_deg, EyeSouthOfHouse().view_angle_deg, 1e-9);
  Eye other = eye;
  other.yaw_deg = -260;  // the same as 100
  EXPECT_NEAR(Between(eye, other, 0.5).yaw_deg, 95, 1e-9);
}

TEST(Picking, CornersThatAreSeenAreFoundAndHiddenOnesAreNot) {
  const PolygonModel house = MakeHouse();
  const Visibility visibility(house);
  const Camera camera = EyeSouthOfHouse().InFrame(kWindowWidth, kWindowHeight);
  const auto corners = FindVisibleCorners(house, visibility, camera);
  const Eigen::Vector3d eave(0, 0, 16);
  const auto picked = PickCorner(corners, *Project(camera, eave) + Eigen::Vector2d(3, -2), 12);
  ASSERT_TRUE(picked);
  EXPECT_EQ(house.points_in_world[picked->point], eave);
  EXPECT_FALSE(PickCorner(corners, {2, 2}, 12));
  for (const VisibleCorner& corner : corners) {
    EXPECT_LT(house.points_in_world[corner.point].y(), 19.9) << "the far wall is hidden";
  }
  const auto face = PickFace(visibility, camera, *Project(camera, {25, 0, 8}));
  ASSERT_TRUE(face);
  EXPECT_NEAR((face->point_in_world - Eigen::Vector3d(25, 0, 8)).norm(), 0, 1e-3);
}

TEST(Picking, TheNearestEdgeIsPickedAnywhereAlongIt) {
  const PolygonModel house = MakeHouse();
  const Visibility visibility(house);
  const Camera camera = EyeSouthOfHouse().InFrame(kWindowWidth, kWindowHeight);
  const auto edges = FindModelEdges(house);
  const auto spans = FindVisibleSpans(house, edges, visibility, camera, 0);
  const Eigen::Vector2d on_corner_edge = *Project(camera, {0, 0, 7});
  const auto span = PickSpan(spans, camera, on_corner_edge + Eigen::Vector2d(-3, 0), 8);
  ASSERT_TRUE(span);
  EXPECT_NEAR(spans[*span].start_in_world.x(), 0, 1e-6);
  EXPECT_NEAR(spans[*span].end_in_world.x(), 0, 1e-6);
}

TEST(NavigatorOptions, AreChecked) {
  ExpectCheckNamesEach<NavigatorOptions>(
      {{"orbit_deg_per_px", [](NavigatorOptions& o) { o.orbit_deg_per_px = 0; }},
       {"look_deg_per_px", [](NavigatorOptions& o) { o.look_deg_per_px = 0; }},
       {"dolly_share", [](NavigatorOptions& o) { o.dolly_share = 1; }},
       {"max_pitch_deg", [](NavigatorOptions& o) { o.max_pitch_deg = 90; }},
       {"eye_height_m", [](NavigatorOptions& o) { o.eye_height_m = 0; }},
       {"step_height_m", [](NavigatorOptions& o) { o.step_height_m = 0; }},
       {"framing", [](NavigatorOptions& o) { o.framing = 0.5; }}});
}

}  // namespace
}  // namespace groundglass
