// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_whitening.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

// Four samples along one edge that may be shifted by 0.8 px and turned by 0.5.
std::vector<AlignedSample> Samples() {
  std::vector<AlignedSample> samples(4);
  for (int i = 0; i < 4; ++i) {
    samples[i].along = -1 + 2.0 * i / 3;
    samples[i].precision = 0.5 + 0.25 * i;
    samples[i].bias_px = {0.8, 0.5 * samples[i].along};
  }
  return samples;
}

TEST(EdgeWhitening, TurnsTheCovarianceOfTheResidualsIntoUnity) {
  const std::vector<AlignedSample> samples = Samples();
  Eigen::MatrixXd a(4, 2);
  for (int i = 0; i < 4; ++i) {
    a.row(i) = std::sqrt(samples[i].precision) * samples[i].bias_px.transpose();
  }
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(4, 4) + a * a.transpose();
  Eigen::MatrixXd whitener = Eigen::MatrixXd::Identity(4, 4);
  EdgeWhitening(samples).Apply(whitener);
  EXPECT_TRUE((whitener * covariance * whitener.transpose()).isIdentity(1e-12));
}

TEST(EdgeWhitening, WorksInPlaceOnAPartOfAMatrix) {
  const std::vector<AlignedSample> samples = Samples();
  Eigen::MatrixXd alone = Eigen::MatrixXd::Random(4, 3);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Constant(6, 3, 7);
  whole.middleRows(1, 4) = alone;
  const EdgeWhitening whitening(samples);
  whitening.Apply(alone);
  whitening.Apply(whole.middleRows(1, 4));
  EXPECT_EQ(whole.middleRows(1, 4), alone);
  EXPECT_TRUE((whole.row(0).array() == 7).all() && (whole.row(5).array() == 7).all());
}

TEST(EdgeWhitening, LeavesEdgesAloneThatLieWhereTheModelHasThem) {
  std::vector<AlignedSample> samples = Samples();
  for (AlignedSample& sample : samples) sample.bias_px.setZero();
  Eigen::VectorXd residuals = Eigen::VectorXd::LinSpaced(4, 1, 4);
  const Eigen::VectorXd before = residuals;
  EdgeWhitening(samples).Apply(residuals);
  EXPECT_EQ(residuals, before);
}

}  // namespace
}  // namespace groundglass
