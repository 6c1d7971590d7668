// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/edge_alignment_cost.h"

#include <gtest/gtest.h>

#include <random>

namespace groundglass {
namespace {

struct AlignmentFixture {
  CameraPrior prior;
  std::vector<AlignedSample> samples;

  AlignmentFixture() {
    ViewTag tag;
    tag.position_in_site = {30, 60, 5};
    tag.lookat_in_site = {20, 0, 10};
    tag.view_angle_deg = 54;
    prior = MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, {});
    const ParameterProjection projection = prior.ProjectionAt(CameraParameters::Zero());
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 24; ++i) {
      AlignedSample sample;
      sample.point_in_world = {20 + 15 * unit(random), 5 * unit(random), 10 + 8 * unit(random)};
      sample.edge = i / 6;
      sample.origin_px = projection.Project(sample.point_in_world)->image_px;
      sample.normal = Eigen::Vector2d(unit(random), unit(random)).normalized();
      sample.offset_px = unit(random);
      sample.precision = 0.5 + 0.4 * unit(random);
      sample.bias_px = {1.5, unit(random)};
      samples.push_back(sample);
    }
  }

  Eigen::VectorXd Residuals(const CameraParameters& whitened) const {
    const EdgeAlignmentCost cost(samples, prior);
    Eigen::VectorXd residuals(samples.size());
    const double* block = whitened.data();
    EXPECT_TRUE(cost.Evaluate(&block, residuals.data(), nullptr));
    return residuals;
  }
};

TEST(EdgeAlignmentCost, SquaredResidualsAreThoseOfTheFullCovariance) {
  const AlignmentFixture fixture;
  const Eigen::VectorXd whitened = fixture.Residuals(CameraParameters::Zero());
  const auto count = static_cast<Eigen::Index>(fixture.samples.size());
  Eigen::VectorXd raw(count);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const AlignedSample& a = fixture.samples[i];
    raw[i] = -std::sqrt(a.precision) * a.offset_px;
    for (Eigen::Index j = 0; j < count; ++j) {
      const AlignedSample& b = fixture.samples[j];
      if (a.edge == b.edge) {
        covariance(i, j) += std::sqrt(a.precision * b.precision) * a.bias_px.dot(b.bias_px);
      }
    }
  }
  EXPECT_NEAR(whitened.squaredNorm(), raw.dot(covariance.ldlt().solve(raw)), 1e-9);
}

TEST(EdgeAlignmentCost, JacobianMatchesFiniteDifferences) {
  const AlignmentFixture fixture;
  CameraParameters at;
  at << 0.1, -0.2, 0.3, 0.1, 0.2, -0.1, 0.3, 0.2, -0.2, 0.1, 0.4;
  const EdgeAlignmentCost cost(fixture.samples, fixture.prior);
  const auto count = static_cast<Eigen::Index>(fixture.samples.size());
  Eigen::Matrix<double, Eigen::Dynamic, kNumCameraParameters, Eigen::RowMajor> jacobian(
      count, kNumCameraParameters);
  Eigen::VectorXd residuals(count);
  const double* block = at.data();
  double* jacobians[] = {jacobian.data()};
  ASSERT_TRUE(cost.Evaluate(&block, residuals.data(), jacobians));
  for (int k = 0; k < kNumCameraParameters; ++k) {
    CameraParameters ahead = at;
    CameraParameters behind = at;
    ahead[k] += 1e-5;
    behind[k] -= 1e-5;
    const Eigen::VectorXd difference =
        (fixture.Residuals(ahead) - fixture.Residuals(behind)) / 2e-5;
    EXPECT_LT((difference - jacobian.col(k)).norm(), 1e-5 * (1 + difference.norm())) << k;
  }
}

}  // namespace
}  // namespace groundglass
