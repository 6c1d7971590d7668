// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/view_tag.h"

#include "scene/formats/view_io.h"
#include "scene/frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace groundglass {
namespace {

// Figure 2 of the thesis (Thorman 1988).
constexpr const char* kS5 =
    "% File: s5.view\n"
    "x 232\n"
    "y -104\n"
    "z 4.5\n"
    "i 104\n"
    "j -2\n"
    "k 33.1\n"
    "a 1.5\n"
    "v 58\n";

TEST(CameraFromTag, ThesisS5LooksAlongItsPitchAndYaw) {
  const ViewTag tag = ParseView(kS5, "s5.view");
  const Camera camera = CameraFromTag(tag, 1500, 1000);
  // The thesis: dist, then pitch = asin(dz / dist), and yaw from its cosine (along y) and sine
  // (along x), in its left-handed frame.
  const double dx = 104 - 232, dy = -2 + 104, dz = 33.1 - 4.5;
  const double distance = std::sqrt(dx * dx + dy * dy + dz * dz);
  const double pitch = std::asin(dz / distance);
  const double yaw =
      std::atan2(dx / (distance * std::cos(pitch)), dy / (distance * std::cos(pitch)));
  const Eigen::Vector3d axis_in_site(
      std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch), std::sin(pitch));
  EXPECT_NEAR((SiteFromWorld(camera.ForwardInWorld()) - axis_in_site).norm(), 0, 1e-14);
  EXPECT_NEAR(DegreesFromRadians(pitch), 9.91187, 1e-5);
  EXPECT_NEAR(DegreesFromRadians(yaw), -51.44953, 1e-5);
  // 1500 px across 58 degrees: 750 / tan 29.
  EXPECT_NEAR(camera.focal_x_px, 1353.0358, 1e-3);
  EXPECT_DOUBLE_EQ(camera.focal_y_px, camera.focal_x_px);
  EXPECT_NEAR(camera.cam_from_world.rotation.determinant(), 1, 1e-14);
  EXPECT_NEAR((camera.PositionInWorld() - Eigen::Vector3d(232, 104, 4.5)).norm(), 0, 1e-12);
}

TEST(CameraFromTag, LookAtPointIsTheCentreAndUpIsUp) {
  const ViewTag tag = ParseView(kS5, "s5.view");
  const Camera camera = CameraFromTag(tag, 1500, 1000);
  const auto center = Project(camera, WorldFromSite(tag.lookat_in_site));
  ASSERT_TRUE(center);
  EXPECT_NEAR((*center - Eigen::Vector2d(750, 500)).norm(), 0, 1e-9);
  const auto above = Project(camera, WorldFromSite(tag.lookat_in_site) + Eigen::Vector3d::UnitZ());
  EXPECT_LT(above->y(), center->y());
  EXPECT_NEAR(above->x(), center->x(), 1e-9);
}

TEST(CameraFromTag, LookingSouthHasEastOnTheLeft) {
  ViewTag tag;
  tag.position_in_site = {0, 0, 0};
  tag.lookat_in_site = {0, 10, 0};  // south in `site`
  const Camera camera = CameraFromTag(tag, 300, 200);
  const auto east = Project(camera, WorldFromSite({1, 10, 0}));
  EXPECT_LT(east->x(), 150);
}

TEST(CameraFromTag, PositiveRollTurnsTheContentCounterclockwise) {
  ViewTag tag;
  tag.lookat_in_site = {0, -10, 0};
  tag.roll_deg = 5;
  const Camera camera = CameraFromTag(tag, 300, 200);
  // A point on the right of the axis moves up as the content turns counterclockwise.
  const auto right = Project(camera, WorldFromSite({1, -10, 0}));
  EXPECT_GT(right->x(), 150);
  EXPECT_LT(right->y(), 100);
  const double angle = std::atan2(100 - right->y(), right->x() - 150);
  EXPECT_NEAR(DegreesFromRadians(angle), 5, 1e-9);
}

TEST(CameraFromTag, NonSquarePixelsFillTheSameFrame) {
  // A 1.5 frame scanned as 640 x 480: the corners see the same rays as in a 1500 x 1000 scan.
  const ViewTag tag = ParseView(kS5, "s5.view");
  const Camera square = CameraFromTag(tag, 1500, 1000);
  const Camera ntsc = CameraFromTag(tag, 640, 480);
  EXPECT_NEAR((UnprojectToWorld(square, {1500, 1000}) - UnprojectToWorld(ntsc, {640, 480})).norm(),
              0,
              1e-14);
}

TEST(TagFromCamera, IsTheInverseOfCameraFromTag) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    ViewTag tag;
    tag.position_in_site = 100 * Eigen::Vector3d(unit(random), unit(random), unit(random));
    tag.lookat_in_site =
        tag.position_in_site + 50 * Eigen::Vector3d(unit(random), 0.1 + unit(random), unit(random));
    tag.view_angle_deg = 50 + 30 * unit(random);
    tag.aspect = 1.5 + 0.3 * unit(random);
    tag.roll_deg = 170 * unit(random);
    tag.shift_x = 0.02 * unit(random);
    tag.shift_y = 0.02 * unit(random);
    tag.k1 = 0.05 * unit(random);
    tag.k2 = 0.01 * unit(random);
    tag.k3 = 0.01 * unit(random);
    tag.p1 = 0.001 * unit(random);
    tag.p2 = 0.001 * unit(random);
    const double distance = (tag.lookat_in_site - tag.position_in_site).norm();
    const ViewTag again = TagFromCamera(CameraFromTag(tag, 640, 480), distance);
    for (int key = 0; key < kNumTagKeys; ++key) {
      EXPECT_NEAR(GetTagValue(tag, static_cast<TagKey>(key)),
                  GetTagValue(again, static_cast<TagKey>(key)),
                  1e-9)
          << kTagKeyNames[key] << " in trial " << trial;
    }
  }
}

TEST(TagFromCamera, AViewStraightDownOrUpBecomesATagThatShowsTheSame) {
  for (const double side : {1.0, -1.0}) {
    Camera camera;
    camera.width_px = 640;
    camera.height_px = 480;
    camera.focal_x_px = camera.focal_y_px = 500;
    camera.center_x_px = 320;
    camera.center_y_px = 240;
    // Picture's right is east and its top north (looking down) or south (looking up).
    camera.cam_from_world.rotation << 1, 0, 0, 0, -side, 0, 0, 0, -side;
    camera.cam_from_world.translation =
        -(camera.cam_from_world.rotation * Eigen::Vector3d(3, 4, 9));
    const ViewTag tag = TagFromCamera(camera, 9);
    ASSERT_FALSE(FindTagFault(tag));
    const Camera again = CameraFromTag(tag, 640, 480);
    for (const Eigen::Vector2d& px : {Eigen::Vector2d(0, 0), Eigen::Vector2d(640, 300)}) {
      const Eigen::Vector3d point = camera.PositionInWorld() + 9 * UnprojectToWorld(camera, px);
      EXPECT_LT((*Project(again, point) - px).norm(), 0.01);
    }
  }
}

}  // namespace
}  // namespace groundglass
