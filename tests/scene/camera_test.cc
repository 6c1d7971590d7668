// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/camera.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

Camera MakeCamera() {
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.focal_x_px = 500;
  camera.focal_y_px = 520;
  camera.center_x_px = 321;
  camera.center_y_px = 236;
  return camera;
}

TEST(Project, OneTenthAtTenIsFivePixels) {
  const auto image = Project(MakeCamera(), {0.1, 0.2, 10});
  ASSERT_TRUE(image);
  EXPECT_DOUBLE_EQ(image->x(), 321 + 5);
  EXPECT_DOUBLE_EQ(image->y(), 236 + 10.4);
}

TEST(Project, SeesNothingBehindTheCamera) {
  EXPECT_FALSE(Project(MakeCamera(), {0, 0, -1}));
  EXPECT_FALSE(Project(MakeCamera(), {0, 0, 0}));
}

TEST(Project, DistortsRadially) {
  Camera camera = MakeCamera();
  camera.k1 = -0.1;
  camera.k2 = 0.02;
  // x = 0.5, r2 = 0.25: s = 1 - 0.025 + 0.00125.
  const auto image = Project(camera, {0.5, 0, 1});
  EXPECT_NEAR(image->x(), 321 + 500 * 0.5 * 0.97625, 1e-12);
}

TEST(Project, SeesNothingWhereTheDistortionTurnsBack) {
  Camera camera = MakeCamera();
  camera.k1 = -0.5;
  EXPECT_TRUE(Project(camera, {0.5, 0, 1}));
  EXPECT_FALSE(Project(camera, {1.0, 0, 1}));  // 1 - 1.5 r2 < 0
}

TEST(Unproject, InvertsProject) {
  Camera camera = MakeCamera();
  camera.k1 = -0.12;
  camera.k2 = 0.03;
  camera.cam_from_world.rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  camera.cam_from_world.translation = {1, -2, 3};
  for (double x = 0; x <= 640; x += 80) {
    for (double y = 0; y <= 480; y += 80) {
      const Eigen::Vector3d point =
          camera.PositionInWorld() + 17 * UnprojectToWorld(camera, {x, y});
      const auto image = Project(camera, point);
      ASSERT_TRUE(image);
      EXPECT_NEAR((*image - Eigen::Vector2d(x, y)).norm(), 0, 1e-9);
    }
  }
}

TEST(ResizedCamera, ScalesTheImageOnly) {
  const Camera camera = MakeCamera();
  const Camera half = ResizedCamera(camera, 320, 120);
  const Eigen::Vector3d point(0.3, -0.4, 2);
  EXPECT_NEAR(Project(half, point)->x(), Project(camera, point)->x() / 2, 1e-12);
  EXPECT_NEAR(Project(half, point)->y(), Project(camera, point)->y() / 4, 1e-12);
}

}  // namespace
}  // namespace groundglass
