// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/tie_point_cost.h"

#include <gtest/gtest.h>

#include <array>

namespace groundglass {
namespace {

struct TiePointFixture {
  TiePointFixture() {
    ViewTag tag;
    tag.position_in_site = {30, 60, 5};
    tag.lookat_in_site = {20, 0, 10};
    tag.view_angle_deg = 54;
    tag.k1 = -0.05;
    prior = SplitIntoOwnAndLens(MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, {}),
                                LensParameters{{0.6, 0.3, 0.5, 0.4, 0.2}});
    TiePoint point;
    point.point_in_world = {21, 2, 10};
    point.normal_in_world = Eigen::Vector3d(0.1, -1, 0.2).normalized();
    frame = FrameOfTiePoint(point, 0.1);
    observation.image_px = {310, 190};
    observation.root_precision << 3, 0.4, -0.2, 5;
  }

  static constexpr int kNumValues = kNumCameraParameters + kNumLensParameters + 3;
  using Values = Eigen::Matrix<double, kNumValues, 1>;
  using Jacobian = Eigen::Matrix<double, 2, kNumValues>;

  Eigen::Vector2d Evaluate(const Values& values, Jacobian* jacobian) const {
    const TiePointCost cost(observation, prior, frame);
    const double* start = values.data();
    const std::array<const double*, 3> blocks = {
        start, start + kNumCameraParameters, start + kNumCameraParameters + kNumLensParameters};
    Eigen::Matrix<double, 2, kNumCameraParameters, Eigen::RowMajor> by_camera;
    Eigen::Matrix<double, 2, kNumLensParameters, Eigen::RowMajor> by_lens;
    Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_point;
    std::array<double*, 3> jacobians = {by_camera.data(), by_lens.data(), by_point.data()};
    Eigen::Vector2d residuals;
    EXPECT_TRUE(
        cost.Evaluate(blocks.data(), residuals.data(), jacobian ? jacobians.data() : nullptr));
    if (jacobian) *jacobian << by_camera, by_lens, by_point;
    return residuals;
  }

  SplitPrior prior;
  TieFrame frame;
  TieObservation observation;
};

TEST(TiePointCost, JacobiansOfAllBlocksMatchFiniteDifferences) {
  const TiePointFixture fixture;
  const TiePointFixture::Values at = TiePointFixture::Values::LinSpaced(-0.4, 0.5);
  TiePointFixture::Jacobian jacobian;
  fixture.Evaluate(at, &jacobian);
  for (int i = 0; i < TiePointFixture::kNumValues; ++i) {
    constexpr double kStep = 1e-5;
    TiePointFixture::Values step = TiePointFixture::Values::Zero();
    step[i] = kStep;
    const Eigen::Vector2d numeric =
        (fixture.Evaluate(at + step, nullptr) - fixture.Evaluate(at - step, nullptr)) / (2 * kStep);
    EXPECT_LT((jacobian.col(i) - numeric).norm(), 1e-4 * (1 + numeric.norm())) << i;
  }
}

TEST(TiePointCost, IsZeroWhereThePointIsSeen) {
  TiePointFixture fixture;
  fixture.observation.image_px =
      fixture.prior.ProjectionAt(CameraParameters::Zero(), LensParameters::Zero())
          .Project({21, 2, 10})
          ->image_px;
  EXPECT_LT(fixture.Evaluate(TiePointFixture::Values::Zero(), nullptr).norm(), 1e-9);
}

TEST(FrameOfTiePoint, ItsThirdAxisIsTheFacesNormal) {
  const TiePointFixture fixture;
  const Eigen::Matrix3d axes = fixture.frame.axes_in_world / 0.1;
  EXPECT_TRUE((axes.transpose() * axes).isIdentity(1e-12));
  EXPECT_TRUE(axes.col(2).isApprox(Eigen::Vector3d(0.1, -1, 0.2).normalized()));
}

TEST(ReliefPriorCost, CountsTheThirdMoveInSigmas) {
  const ReliefPriorCost cost(4);
  const std::array<double, 3> move = {7, -3, 2};
  const double* block = move.data();
  double residual = 0;
  std::array<double, 3> derivative{};
  double* jacobian = derivative.data();
  ASSERT_TRUE(cost.Evaluate(&block, &residual, &jacobian));
  EXPECT_DOUBLE_EQ(residual, 0.5);
  EXPECT_EQ(derivative, (std::array<double, 3>{0, 0, 0.25}));
}

}  // namespace
}  // namespace groundglass
