// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/parameter_projection.h"

#include "scene/frames.h"

#include <gtest/gtest.h>

#include <random>

namespace groundglass {
namespace {

ViewTag OddTag() {
  ViewTag tag;
  tag.position_in_site = {232, -104, 4.5};
  tag.lookat_in_site = {104, -2, 33.1};
  tag.aspect = 1.46;
  tag.view_angle_deg = 58;
  tag.roll_deg = 1.7;
  tag.shift_x = 0.02;
  tag.shift_y = -0.013;
  tag.k1 = -0.03;
  tag.k2 = 0.01;
  tag.k3 = -0.004;
  tag.p1 = 0.002;
  tag.p2 = -0.003;
  return tag;
}

TEST(ParameterProjection, AgreesWithTheCameraThatTheTagDescribes) {
  const ViewTag tag = OddTag();
  const Camera camera = CameraFromTag(tag, 640, 480);
  const ParameterProjection projection(ParametersFromTag(tag), TagDistortion(tag), 640, 480);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> spread(-40, 40);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d point(104 + spread(random), 2 + spread(random), 20 + spread(random));
    const auto expected = Project(camera, point);
    const auto found = projection.Project(point);
    ASSERT_EQ(expected.has_value(), found.has_value());
    if (expected) {
      EXPECT_LT((*expected - found->image_px).norm(), 1e-8);
      EXPECT_EQ(found->image_px, *projection.ImageOf(point));
    }
  }
}

TEST(ParameterProjection, DerivativesMatchFiniteDifferences) {
  const ViewTag tag = OddTag();
  const CameraParameters parameters = ParametersFromTag(tag);
  const Eigen::Vector3d point(96, 12, 48);
  const auto result = ParameterProjection(parameters, TagDistortion(tag), 640, 480).Project(point);
  ASSERT_TRUE(result);
  for (int k = 0; k < kNumCameraParameters; ++k) {
    const double step = 1e-5;
    CameraParameters ahead = parameters;
    CameraParameters behind = parameters;
    ahead[k] += step;
    behind[k] -= step;
    const Eigen::Vector2d difference =
        (ParameterProjection(ahead, TagDistortion(tag), 640, 480).Project(point)->image_px -
         ParameterProjection(behind, TagDistortion(tag), 640, 480).Project(point)->image_px) /
        (2 * step);
    EXPECT_LT((difference - result->jacobian.col(k)).norm(), 1e-5 * (1 + difference.norm()))
        << kCameraParameterNames[k];
  }
}

TEST(ParameterProjection, APointBehindTheCameraHasNoImage) {
  const ViewTag tag = OddTag();
  const ParameterProjection projection(ParametersFromTag(tag), {}, 640, 480);
  const Eigen::Vector3d behind =
      WorldFromSite(tag.position_in_site - (tag.lookat_in_site - tag.position_in_site));
  EXPECT_FALSE(projection.Project(behind));
  EXPECT_FALSE(projection.ImageOf(behind));
}

}  // namespace
}  // namespace groundglass
