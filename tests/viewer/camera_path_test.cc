// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/camera_path.h"

#include "scene/error.h"
#include "tests/viewer/sample_models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

double AngleBetween(const Camera& a, const Camera& b) {
  const Eigen::Matrix3d turn = a.cam_from_world.rotation * b.cam_from_world.rotation.transpose();
  return Eigen::AngleAxisd(turn).angle();
}

void ExpectSameCamera(const Camera& a, const Camera& b) {
  EXPECT_NEAR((a.PositionInWorld() - b.PositionInWorld()).norm(), 0, 1e-9);
  EXPECT_NEAR(AngleBetween(a, b), 0, 1e-7);
  EXPECT_NEAR(a.focal_x_px, b.focal_x_px, 1e-9);
  EXPECT_NEAR(a.center_y_px, b.center_y_px, 1e-9);
}

std::vector<Camera> FourSides() {
  return {MakeCamera({0, -9, 1}, {0, 0, 0}, 320, 240, 300),
          MakeCamera({10, -2, 2}, {0, 0, 0}, 320, 240, 340),
          MakeCamera({1, 8, 1}, {0.5, 0, 0}, 320, 240, 300),
          MakeCamera({-9, 1, 3}, {0, 0, 0}, 320, 240, 280)};
}

TEST(CameraPath, FlightStartsAndEndsAtItsCameras) {
  const std::vector<Camera> cameras = FourSides();
  const std::vector<Camera> path = MakeFlight(MakeCheckeredBox().model, cameras, 100);
  ASSERT_EQ(path.size(), 100);
  ExpectSameCamera(path.front(), cameras.front());
  ExpectSameCamera(path.back(), cameras.back());
}

TEST(CameraPath, FlightPassesEachCamera) {
  const std::vector<Camera> cameras = FourSides();
  const std::vector<Camera> path = MakeFlight(MakeCheckeredBox().model, cameras, 2000);
  for (const Camera& camera : cameras) {
    double nearest = 1e9;
    for (const Camera& frame : path) {
      nearest = std::min(nearest,
                         (frame.PositionInWorld() - camera.PositionInWorld()).norm() +
                             AngleBetween(frame, camera));
    }
    EXPECT_LT(nearest, 0.03);
  }
}

TEST(CameraPath, FlightGoesAroundTheModelWithItInSight) {
  // Opposite sides: straight on would lead through the box.
  const std::vector<Camera> cameras = {MakeCamera({1, -9, 1}, {0, 0, 0}, 320, 240, 300),
                                       MakeCamera({1, 9, 1}, {0, 0, 0}, 320, 240, 300)};
  for (const Camera& camera : MakeFlight(MakeCheckeredBox().model, cameras, 50)) {
    EXPECT_GT(camera.PositionInWorld().head<2>().norm(), 8);
    EXPECT_GT(camera.ForwardInWorld().dot(-camera.PositionInWorld().normalized()), 0.98);
  }
}

TEST(CameraPath, FlightIsEvenAndSmooth) {
  const std::vector<Camera> path = MakeFlight(MakeCheckeredBox().model, FourSides(), 400);
  // No step is much longer than its neighbours.
  for (size_t i = 2; i < path.size(); ++i) {
    const double before = (path[i - 1].PositionInWorld() - path[i - 2].PositionInWorld()).norm();
    const double now = (path[i].PositionInWorld() - path[i - 1].PositionInWorld()).norm();
    EXPECT_LT(std::abs(now - before), 0.02) << i;
    EXPECT_LT(AngleBetween(path[i], path[i - 1]), 0.03) << i;
  }
}

TEST(CameraPath, OneViewIsAStandingFilm) {
  const Camera camera = FourSides().front();
  for (const Camera& frame : MakeFlight(MakeCheckeredBox().model, {camera, camera}, 5)) {
    ExpectSameCamera(frame, camera);
  }
}

// Photographs that lie, stand, and were scanned twice as large.
std::vector<Camera> MixedSizes() {
  return {MakeCamera({0, -9, 1}, {0, 0, 0}, 320, 240, 300),
          MakeCamera({10, -2, 2}, {0, 0, 0}, 240, 320, 300),
          MakeCamera({1, 8, 1}, {0.5, 0, 0}, 320, 240, 300),
          MakeCamera({-9, 1, 3}, {0, 0, 0}, 640, 480, 600)};
}

TEST(CameraPath, ViewsOfSeveralSizesFlyInTheFrameThatMostHave) {
  const std::vector<Camera> cameras = MixedSizes();
  const std::vector<Camera> path = MakeFlight(MakeCheckeredBox().model, cameras, 200);
  for (const Camera& frame : path) {
    EXPECT_EQ(frame.width_px, 320);
    EXPECT_EQ(frame.height_px, 240);
  }
  ExpectSameCamera(path.front(), cameras.front());
  // The same lens on a scan twice as large.
  ExpectSameCamera(path.back(), MakeCamera({-9, 1, 3}, {0, 0, 0}, 320, 240, 300));
}

TEST(CameraPath, TheCommonFrameIsTheOneOfMostOrTheLargest) {
  std::vector<Camera> cameras = MixedSizes();
  EXPECT_EQ(CommonFrame(cameras).width, 320);
  EXPECT_EQ(CommonFrame(cameras).height, 240);
  cameras.erase(cameras.begin());
  EXPECT_EQ(CommonFrame(cameras).width, 640);
  cameras.pop_back();
  EXPECT_EQ(CommonFrame(cameras).width, 320) << "lying, not upright";
  EXPECT_EQ(CommonFrame({}).width, 0);
}

TEST(CameraPath, AFittedCameraHoldsAllThatItsOwnFrameHolds) {
  Camera upright = MakeCamera({0, -9, 1}, {0, 0, 0}, 240, 320, 300);
  upright.center_x_px += 6;
  upright.center_y_px -= 9;
  upright.focal_y_px = 330;
  const Camera fitted = FittedCamera(upright, 320, 240);
  EXPECT_EQ(fitted.PositionInWorld(), upright.PositionInWorld());
  EXPECT_EQ(fitted.ForwardInWorld(), upright.ForwardInWorld());
  EXPECT_DOUBLE_EQ(fitted.focal_x_px, fitted.focal_y_px);
  const auto seen_at = [&](double x_px, double y_px) {
    return *ProjectFromCam(fitted, UnprojectToCam(upright, {x_px, y_px}));
  };
  EXPECT_NEAR(seen_at(0, 0).y(), 0, 1e-9);
  EXPECT_NEAR(seen_at(240, 320).y(), 240, 1e-9);
  EXPECT_NEAR(seen_at(0, 0).x() + seen_at(240, 0).x(), 320, 1e-9);
  EXPECT_GT(seen_at(0, 0).x(), 0);
}

TEST(CameraPath, NoViewsAreAnError) {
  EXPECT_THROW(MakeFlight(MakeCheckeredBox().model, {}, 10), Error);
}

TEST(CameraPath, OrbitKeepsTheWholeModelInTheFrameAndFillsIt) {
  const PolygonModel model = MakeCheckeredBox().model;
  double widest = 0;
  for (const Camera& camera : MakeOrbit(model, 24)) {
    for (const Eigen::Vector3d& point : model.points_in_world) {
      const auto image_px = Project(camera, point);
      ASSERT_TRUE(image_px && IsInsideFrame(camera, *image_px));
      widest = std::max({widest,
                         std::abs(image_px->x() / camera.width_px - 0.5) * 2,
                         std::abs(image_px->y() / camera.height_px - 0.5) * 2});
    }
  }
  EXPECT_NEAR(widest, 0.9, 1e-6);
}

TEST(CameraPath, OrbitStartsInTheSouthAndGoesClockwise) {
  const std::vector<Camera> path = MakeOrbit(MakeCheckeredBox().model, 4);
  EXPECT_LT(path[0].PositionInWorld().y(), -5);  // south
  EXPECT_LT(path[1].PositionInWorld().x(), -5);  // then west: clockwise seen from above
}

TEST(CameraPath, ReframingKeepsTheHorizontalViewAndMakesPixelsSquare) {
  Camera camera = MakeCamera({0, -9, 1}, {0, 0, 0}, 640, 480, 700);
  camera.focal_y_px = 770;
  camera.center_x_px = 330;
  camera.center_y_px = 251;
  const Camera film = ReframedCamera(camera, 1280, 720);
  EXPECT_DOUBLE_EQ(film.focal_x_px, 1400);
  EXPECT_DOUBLE_EQ(film.focal_y_px, 1400);
  // The same ray meets the same place, counted from the middle in square pixels.
  const Eigen::Vector2d before = *ProjectFromCam(camera, {0.1, 0.05, 1});
  const Eigen::Vector2d after = *ProjectFromCam(film, {0.1, 0.05, 1});
  EXPECT_NEAR(after.x() - 640, 2 * (before.x() - 320), 1e-9);
  EXPECT_NEAR(after.y() - 360, 2 * (before.y() - 240) * 700 / 770, 1e-9);
}

}  // namespace
}  // namespace groundglass
