// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/camera_prior.h"

#include "scene/error.h"
#include "scene/frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace groundglass {
namespace {

ViewTag LevelTag() {
  ViewTag tag;
  tag.position_in_site = {0, 100, 5};
  tag.lookat_in_site = {0, 0, 5};
  tag.view_angle_deg = 54;
  return tag;
}

CameraCovariance CovarianceOf(const CameraPrior& prior) {
  return prior.root * prior.root.transpose();
}

TEST(CameraPrior, TheLargerOfLengthAndShareOfDistanceCounts) {
  ViewTag tag = LevelTag();
  const CameraPrior far = MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, {});
  EXPECT_NEAR(far.sigmas[0], 0.5, 1e-9);  // 0.5 % of 100 ft
  tag.lookat_in_site = {0, 90, 5};
  const CameraPrior near = MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, {});
  EXPECT_NEAR(near.sigmas[0], 0.076 / kMetresPerFoot, 1e-9);
}

// 100 ft away, of which the shares would be ten and more times as much.
TEST(CameraPrior, LengthsThatAreGivenStandHoweverFarAwayTheCameraIs) {
  PolygonModel house;
  house.points_in_world = {{0, 0, 0}, {60, 60, 60}};
  PriorOptions given;
  given.position_m = 0.01;
  given.height_m = 0.02;
  given.lookat_m = 0.01;
  // Once for the model and once more changes nothing.
  given = PriorSuitedTo(house, PriorSuitedTo(house, given));
  ViewTag tag = LevelTag();
  CameraPrior prior = MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, given);
  EXPECT_NEAR(prior.sigmas[0], 0.01 / kMetresPerFoot, 1e-9);
  EXPECT_NEAR(prior.sigmas[2], 0.02 / kMetresPerFoot, 1e-9);
  const double yaw_deg = DegreesFromRadians(std::hypot(0.01, 0.01) / kMetresPerFoot / 100);
  EXPECT_NEAR(prior.sigmas[3], yaw_deg, 1e-6);
  tag.sigmas.position = 2;
  prior = MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, given);
  EXPECT_NEAR(prior.sigmas[0], 2, 1e-9);
}

TEST(CameraPrior, TheTagsOwnSigmasWin) {
  ViewTag tag = LevelTag();
  tag.sigmas.position = 2;
  tag.sigmas.roll_deg = 0.3;
  const CameraPrior prior = MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, {});
  EXPECT_NEAR(prior.sigmas[0], 2, 1e-9);
  EXPECT_NEAR(prior.sigmas[5], 0.3, 1e-9);
}

// Position and look-at point are measured apart: drawing both from their errors gives cameras with
// exactly the prior's covariance.
TEST(CameraPrior, CovarianceIsThatOfMeasuredPoints) {
  const ViewTag tag = LevelTag();
  const CameraPrior prior = MakeCameraPrior(tag, 600, 400, LengthUnit::kMetre, {}, {});
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  CameraCovariance sum = CameraCovariance::Zero();
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    ViewTag drawn = tag;
    drawn.position_in_site +=
        Eigen::Vector3d(0.5 * normal(random), 0.5 * normal(random), 0.2 * normal(random));
    drawn.lookat_in_site += Eigen::Vector3d(normal(random), normal(random), normal(random));
    CameraParameters change = ParametersFromTag(drawn) - prior.mean;
    change[3] = std::remainder(change[3], 360.0);
    sum += change * change.transpose();
  }
  sum /= kDraws;
  const CameraCovariance expected = CovarianceOf(prior);
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      EXPECT_NEAR(sum(i, j), expected(i, j), 0.05 * prior.sigmas[i] * prior.sigmas[j])
          << kCameraParameterNames[i] << " " << kCameraParameterNames[j];
    }
  }
}

TEST(CameraPrior, LockedParametersDoNotMove) {
  PriorOptions options;
  options.lock = {"v", "shift"};
  const CameraPrior prior = MakeCameraPrior(LevelTag(), 600, 400, LengthUnit::kFoot, {}, options);
  for (const int locked : {6, 8, 9}) {
    EXPECT_EQ(prior.sigmas[locked], 0);
    EXPECT_LT(prior.root.row(locked).norm(), 1e-12);
  }
  EXPECT_GT(prior.sigmas[5], 0);
}

TEST(CameraPrior, FreeParametersAreLookedForWhateverTheTagOrTheLensSays) {
  ViewTag tag = LevelTag();
  tag.sigmas.roll_deg = 0.01;
  PriorOptions options;
  options.free = {"roll", "k1"};
  EXPECT_DOUBLE_EQ(MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, {}).sigmas[5], 0.01);
  EXPECT_DOUBLE_EQ(MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, options).sigmas[5], 1.5);
  Lens lens;
  lens.view_angle_deg = 53.2;
  lens.aspect = 1.5;
  EXPECT_EQ(MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, lens, {}).sigmas[10], 0);
  EXPECT_DOUBLE_EQ(MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, lens, options).sigmas[10],
                   0.05);
}

TEST(CameraPrior, AParameterCannotBeBothLockedAndFree) {
  PriorOptions options;
  options.lock = {"v", "k1"};
  options.free = {"k1"};
  try {
    options.Check();
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "options lock and free: 'k1' is in both");
  }
}

TEST(CameraPrior, ALensFileReplacesTheLensInTheTag) {
  Lens lens;
  lens.view_angle_deg = 53.2;
  lens.sigma_view_angle_deg = 0.02;
  lens.aspect = 1.5;
  lens.sigma_aspect = 1e-4;
  lens.k1 = -0.018;
  lens.sigma_k1 = 0.001;
  PriorOptions digital;
  digital.digital = true;
  const CameraPrior prior = MakeCameraPrior(LevelTag(), 600, 400, LengthUnit::kFoot, lens, digital);
  EXPECT_DOUBLE_EQ(prior.mean[6], 53.2);
  EXPECT_NEAR(prior.sigmas[6], 0.02, 1e-12);
  EXPECT_NEAR(prior.sigmas[10], 0.001, 1e-12);
  // A slide's own scale comes on top: 1 % of the image is 1 % of tan(v / 2).
  const CameraPrior slide = MakeCameraPrior(LevelTag(), 600, 400, LengthUnit::kFoot, lens, {});
  const double wider =
      2 * DegreesFromRadians(std::atan(1.01 * std::tan(RadiansFromDegrees(53.2) / 2))) - 53.2;
  EXPECT_NEAR(slide.sigmas[6], std::hypot(0.02, wider), 0.01);
}

TEST(CameraPrior, WhitenedParametersAreThoseOfTheCamera) {
  PriorOptions options;
  options.lock = {"v"};
  const CameraPrior prior = MakeCameraPrior(LevelTag(), 600, 400, LengthUnit::kFoot, {}, options);
  const CameraParameters parameters = prior.ParametersAt(CameraParameters::LinSpaced(-2, 3));
  EXPECT_TRUE(prior.ParametersAt(prior.WhitenedAt(parameters)).isApprox(parameters, 1e-9));
  CameraParameters turned = parameters;
  turned[kYaw] += 360;
  EXPECT_TRUE(prior.WhitenedAt(turned).isApprox(prior.WhitenedAt(parameters), 1e-9));
}

TEST(CameraPrior, AWiderPoseScalesPositionAndDirectionOnly) {
  const CameraPrior prior = MakeCameraPrior(LevelTag(), 600, 400, LengthUnit::kFoot, {}, {});
  const CameraPrior wider = WithWiderPose(prior, 3);
  const CameraCovariance before = CovarianceOf(prior);
  const CameraCovariance after = CovarianceOf(wider);
  EXPECT_TRUE((after.topLeftCorner<5, 5>()).isApprox(9 * before.topLeftCorner<5, 5>(), 1e-9));
  EXPECT_TRUE((after.bottomRightCorner<6, 6>()).isApprox(before.bottomRightCorner<6, 6>(), 1e-9));
  EXPECT_NEAR(wider.sigmas[kYaw], 3 * prior.sigmas[kYaw], 1e-12);
  PriorOptions overclaimed;
  overclaimed.overclaim = 3;
  EXPECT_TRUE(
      CovarianceOf(MakeCameraPrior(LevelTag(), 600, 400, LengthUnit::kFoot, {}, overclaimed))
          .isApprox(after, 1e-12));
}

TEST(CameraPrior, ADigitalCamerasPrincipalPointIsNearerThanASlides) {
  PriorOptions options;
  const auto sigma = [&] {
    return MakeCameraPrior(LevelTag(), 640, 427, LengthUnit::kFoot, {}, options).sigmas[kShiftX];
  };
  EXPECT_NEAR(sigma(), options.slide_shift, 1e-12);
  options.digital = true;
  EXPECT_NEAR(sigma(), options.digital_shift, 1e-12);
  options.shift = 0.02;  // somebody knows better
  EXPECT_NEAR(sigma(), 0.02, 1e-12);
}

TEST(CameraPrior, ADigitalCamerasPixelsAreSquare) {
  PriorOptions digital;
  digital.digital = true;
  ViewTag tag = LevelTag();
  tag.aspect = 1.5;  // rounded
  const auto prior = [&] { return MakeCameraPrior(tag, 640, 427, LengthUnit::kFoot, {}, digital); };
  EXPECT_DOUBLE_EQ(prior().mean[kAspect], 640.0 / 427);
  EXPECT_LT(prior().sigmas[kAspect], 0.001);
  tag.aspect = 1.45;  // no rounded number: these pixels are not square
  EXPECT_DOUBLE_EQ(prior().mean[kAspect], 1.45);
  tag.aspect = 1.5;
  tag.sigmas.aspect = 0.01;  // the tag's own word wins
  EXPECT_DOUBLE_EQ(prior().mean[kAspect], 1.5);
}

TEST(CameraPrior, AnUnknownLockNamesTheOnesThereAre) {
  PriorOptions options;
  options.lock = {"zoom"};
  try {
    options.Check();
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no parameter is called 'zoom'"), std::string::npos);
  }
}

}  // namespace
}  // namespace groundglass
