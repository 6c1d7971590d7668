// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/camera_errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

// A square 10 ft wide, 20 ft north of the origin and centred on the axis of MakeCamera.
PolygonModel UntexturedWall() {
  PolygonModel model;
  model.points_in_world = {{-5, 20, -5}, {5, 20, -5}, {5, 20, 5}, {-5, 20, 5}};
  model.faces = {{{0, 1, 2, 3}, "wall"}};
  return model;
}

Camera MakeCamera() {
  ViewTag tag;
  tag.position_in_site = {0, 0, 0};
  tag.lookat_in_site = {0, -20, 0};
  tag.view_angle_deg = 90;
  return CameraFromTag(tag, 600, 400);
}

TEST(VertexError, OneFootAsideAtTwentyFeetIsATwentiethOfTheFocalLength) {
  const Camera true_camera = MakeCamera();
  Camera found_camera = true_camera;
  found_camera.cam_from_world.translation.x() += 1;
  const VertexError error = MeasureVertexError(UntexturedWall(), true_camera, found_camera);
  EXPECT_EQ(error.num_points, 4);
  EXPECT_NEAR(error.mean_px, 300.0 / 20, 1e-9);
  EXPECT_NEAR(error.max_px, 300.0 / 20, 1e-9);
}

TEST(VertexError, PointsOutsideTheTrueFrameDoNotCount) {
  PolygonModel model = UntexturedWall();
  model.points_in_world[0].x() = -25;
  EXPECT_EQ(MeasureVertexError(model, MakeCamera(), MakeCamera()).num_points, 3);
}

TEST(WrongAccepted, ThreePixelsAtSixHundredAndFortyWide) {
  EXPECT_DOUBLE_EQ(WrongAcceptedThresholdPx(640), 3);
  EXPECT_DOUBLE_EQ(WrongAcceptedThresholdPx(1280), 6);
}

TEST(CameraErrors, EachNumberOfTheTagComesBack) {
  ViewTag tag;
  tag.position_in_site = {232, -104, 4.5};
  tag.lookat_in_site = {104, -2, 33.1};
  const Camera true_camera = CameraFromTag(tag, 600, 400);
  ViewTag changed = tag;
  changed.position_in_site += Eigen::Vector3d(0.3, 0, 0.4);
  changed.lookat_in_site += Eigen::Vector3d(0.3, 0, 0.4);
  changed.roll_deg = 1.25;
  changed.view_angle_deg += 0.5;
  changed.shift_x = 0.01;
  const CameraErrors errors =
      MeasureCameraErrors(UntexturedWall(), true_camera, CameraFromTag(changed, 600, 400));
  EXPECT_NEAR(errors.position, 0.5, 1e-9);
  EXPECT_NEAR(errors.direction_deg, 0, 1e-9);
  EXPECT_NEAR(errors.parameters[0], 0.3, 1e-9);
  EXPECT_NEAR(errors.parameters[2], 0.4, 1e-9);
  EXPECT_NEAR(errors.parameters[5], 1.25, 1e-9);
  EXPECT_NEAR(errors.parameters[6], 0.5, 1e-9);
  EXPECT_NEAR(errors.parameters[8], 0.01, 1e-9);
}

TEST(Calibration, OneParameterIsInsideUpToOnePointNineSixSigma) {
  CameraCovariance covariance = CameraCovariance::Zero();
  covariance(2, 2) = 0.01;
  CameraParameters errors = CameraParameters::Zero();
  errors[2] = 0.195;
  errors[4] = 100;  // has no variance, so it is not judged
  const auto inside = MeasureCalibration(errors, covariance);
  ASSERT_TRUE(inside.has_value());
  EXPECT_EQ(inside->degrees_of_freedom, 1);
  EXPECT_TRUE(inside->is_inside_95);
  errors[2] = 0.197;
  EXPECT_FALSE(MeasureCalibration(errors, covariance)->is_inside_95);
}

// From tables of the chi-squared distribution: 1.386 and 5.991 with 2 degrees of freedom, 0.584 and
// 7.815 with 3, 10.341 and 19.675 with 11.
TEST(Calibration, ConfidenceIsTheChiSquaredDistributions) {
  const auto confidence = [](int num_parameters, double mahalanobis_squared) {
    CameraCovariance covariance = CameraCovariance::Zero();
    CameraParameters errors = CameraParameters::Zero();
    errors[0] = std::sqrt(mahalanobis_squared);
    for (int i = 0; i < num_parameters; ++i) covariance(i, i) = 1;
    return MeasureCalibration(errors, covariance)->confidence;
  };
  EXPECT_NEAR(confidence(1, 1), 0.6827, 1e-4);
  EXPECT_NEAR(confidence(2, 1.386), 0.5, 1e-3);
  EXPECT_NEAR(confidence(2, 5.991), 0.95, 1e-4);
  EXPECT_NEAR(confidence(3, 0.584), 0.1, 1e-3);
  EXPECT_NEAR(confidence(3, 7.815), 0.95, 1e-4);
  EXPECT_NEAR(confidence(11, 10.341), 0.5, 1e-3);
  EXPECT_NEAR(confidence(11, 19.675), 0.95, 1e-4);
  EXPECT_EQ(confidence(11, 0), 0);
  EXPECT_NEAR(confidence(11, 1e4), 1, 1e-12);
}

TEST(Calibration, CorrelatedErrorsAlongTheLongAxisAreSmall) {
  CameraCovariance covariance = CameraCovariance::Zero();
  covariance(0, 0) = covariance(3, 3) = 1;
  covariance(0, 3) = covariance(3, 0) = 0.99;
  CameraParameters errors = CameraParameters::Zero();
  errors[0] = errors[3] = 2;
  EXPECT_NEAR(MeasureCalibration(errors, covariance)->mahalanobis_squared, 8 / 1.99, 1e-9);
  errors[3] = -2;
  EXPECT_NEAR(MeasureCalibration(errors, covariance)->mahalanobis_squared, 8 / 0.01, 1e-6);
}

TEST(Calibration, NothingIsClaimedByAZeroCovariance) {
  EXPECT_FALSE(MeasureCalibration(CameraParameters::Ones(), CameraCovariance::Zero()).has_value());
}

}  // namespace
}  // namespace groundglass
