// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/camera_model.h"

#include "scene/camera.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include <random>
#include <vector>

namespace groundglass {
namespace {

// From mild to wild: each term alone and all together, barrels, pincushions and those that fold.
std::vector<Distortion<double>> SampleLenses() {
  return {{},
          {-0.012, 0.003, 0, 0.00012, -0.00031},
          {-0.3, 0.1, 0, 0, 0},
          {0.2, 0, 0, 0, 0},
          {-0.5, 0.1, 0, 0, 0},
          {0, 0, -0.05, 0, 0},
          {-0.28, 0.09, -0.015, 0.002, -0.001},
          {0.1, -0.2, 0.1, -0.01, 0.02},
          {-0.4, 0, 0, 0.01, 0.01},
          {0, 0, 0, 0.02, -0.03}};
}

std::vector<Eigen::Vector2d> SamplePoints(double reach) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> spread(-reach, reach);
  std::vector<Eigen::Vector2d> points = {{0, 0}};
  for (int i = 0; i < 200; ++i) points.emplace_back(spread(random), spread(random));
  return points;
}

TEST(CameraModel, AgreesWithOpenCv) {
  for (const Distortion<double>& lens : SampleLenses()) {
    std::vector<cv::Point3d> in_cam;
    for (const Eigen::Vector2d& point : SamplePoints(0.9)) {
      in_cam.emplace_back(2 * point.x(), 2 * point.y(), 2);
    }
    const cv::Matx33d intrinsics(500, 0, 321, 0, 520, 236, 0, 0, 1);
    const std::vector<double> coefficients = {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
    std::vector<cv::Point2d> expected;
    cv::projectPoints(
        in_cam, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), intrinsics, coefficients, expected);
    Camera camera;
    camera.focal_x_px = 500;
    camera.focal_y_px = 520;
    camera.center_x_px = 321;
    camera.center_y_px = 236;
    camera.k1 = lens.k1;
    camera.k2 = lens.k2;
    camera.k3 = lens.k3;
    camera.p1 = lens.p1;
    camera.p2 = lens.p2;
    int num_seen = 0;
    for (size_t i = 0; i < in_cam.size(); ++i) {
      const auto image = Project(camera, {in_cam[i].x, in_cam[i].y, in_cam[i].z});
      if (!image) continue;  // beyond the fold, which OpenCV does not know
      ++num_seen;
      EXPECT_NEAR(image->x(), expected[i].x, 1e-9);
      EXPECT_NEAR(image->y(), expected[i].y, 1e-9);
    }
    EXPECT_GT(num_seen, 100);
  }
}

TEST(CameraModel, DerivativeMatchesFiniteDifferencesAndJets) {
  using Jet = ceres::Jet<double, 2>;
  for (const Distortion<double>& lens : SampleLenses()) {
    Distortion<Jet> jet_lens;
    jet_lens.k1 = Jet(lens.k1);
    jet_lens.k2 = Jet(lens.k2);
    jet_lens.k3 = Jet(lens.k3);
    jet_lens.p1 = Jet(lens.p1);
    jet_lens.p2 = Jet(lens.p2);
    for (const Eigen::Vector2d& point : SamplePoints(1.2)) {
      const Eigen::Matrix2d derivative = DistortionDerivative<double>(lens, point);
      Eigen::Matrix2d difference;
      for (int k = 0; k < 2; ++k) {
        const Eigen::Vector2d step = 1e-6 * Eigen::Vector2d::Unit(k);
        difference.col(k) =
            (Distort<double>(lens, point + step) - Distort<double>(lens, point - step)) / 2e-6;
      }
      EXPECT_LT((derivative - difference).norm(), 1e-8);

      const Eigen::Matrix<Jet, 2, 1> jet_point(Jet(point.x(), 0), Jet(point.y(), 1));
      const Eigen::Matrix<Jet, 2, 1> distorted = Distort<Jet>(jet_lens, jet_point);
      const Eigen::Vector2d expected = Distort<double>(lens, point);
      for (int row = 0; row < 2; ++row) {
        EXPECT_NEAR(distorted[row].a, expected[row], 1e-14);
        EXPECT_NEAR(distorted[row].v[0], derivative(row, 0), 1e-12);
        EXPECT_NEAR(distorted[row].v[1], derivative(row, 1), 1e-12);
      }
    }
  }
}

TEST(CameraModel, UndistortInvertsDistortBeforeTheFold) {
  for (const Distortion<double>& lens : SampleLenses()) {
    int num_before = 0;
    for (const Eigen::Vector2d& point : SamplePoints(1.5)) {
      if (!IsBeforeFold(lens, point)) continue;
      ++num_before;
      // At the fold itself the inverse is as ill-conditioned as can be.
      const double least = DistortionDerivative<double>(lens, point).determinant();
      EXPECT_LT((Undistort(lens, Distort<double>(lens, point)) - point).norm(),
                1e-13 / std::min(1.0, least * least))
          << point.transpose() << ", k1 " << lens.k1;
    }
    EXPECT_GT(num_before, 30);
  }
}

TEST(CameraModel, UndistortStaysBeforeTheFoldWhateverTheImagePoint) {
  for (const Distortion<double>& lens : SampleLenses()) {
    for (const Eigen::Vector2d& distorted : SamplePoints(40)) {
      const Eigen::Vector2d point = Undistort(lens, distorted);
      ASSERT_TRUE(point.allFinite());
      EXPECT_TRUE(IsBeforeFold(lens, 0.999 * point)) << distorted.transpose();
    }
  }
}

TEST(CameraModel, NothingIsSeenBeyondAFoldEvenWhereTheSlopeIsUpwardAgain) {
  // 1 - 1.5 r2 + 0.5 r2^2 is below 0 for r2 from 1 to 2 and above it from there on.
  const Distortion<double> lens = {-0.5, 0.1, 0, 0, 0};
  EXPECT_TRUE(IsBeforeFold(lens, {0.99, 0}));
  EXPECT_FALSE(IsBeforeFold(lens, {1.2, 0}));
  EXPECT_FALSE(IsBeforeFold(lens, {2, 0}));
  // The same with k3: 1 - 3 u + 3 u^2 - 0.98 u^3 with u = r2 / 1 dips below 0 once, late.
  const Distortion<double> late = {-1, 0.6, -0.14, 0, 0};
  EXPECT_TRUE(IsBeforeFold(late, {0.9, 0}));
  EXPECT_FALSE(IsBeforeFold(late, {1.3, 0}));
}

TEST(CameraModel, TurnedPicturesHaveTurnedCameras) {
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.focal_x_px = 500;
  camera.focal_y_px = 520;
  camera.center_x_px = 321;
  camera.center_y_px = 236;
  camera.k1 = -0.1;
  camera.k3 = 0.02;
  camera.p1 = 0.003;
  camera.p2 = -0.005;
  camera.cam_from_world.translation = {0.1, 0.2, 3};
  const Eigen::Vector3d point(0.5, -0.7, 0.3);
  const Eigen::Vector2d image = *Project(camera, point);
  // Clockwise: the left side becomes the top.
  const Eigen::Vector2d once = *Project(TurnedCamera(camera, 1), point);
  EXPECT_NEAR(once.x(), 480 - image.y(), 1e-9);
  EXPECT_NEAR(once.y(), image.x(), 1e-9);
  const Eigen::Vector2d twice = *Project(TurnedCamera(camera, 2), point);
  EXPECT_NEAR(twice.x(), 640 - image.x(), 1e-9);
  EXPECT_NEAR(twice.y(), 480 - image.y(), 1e-9);
  EXPECT_LT((*Project(TurnedCamera(TurnedCamera(camera, 3), 1), point) - image).norm(), 1e-9);
}

}  // namespace
}  // namespace groundglass
