// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/covariance_excess.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(CovarianceExcess, WidensWhereErrorsAreLargerThanCountedOnAndNarrowsNowhere) {
  const Eigen::MatrixXd covariance = Eigen::Vector3d(4, 9, 1).asDiagonal();
  const Eigen::MatrixXd counted = Eigen::Vector3d(3, 9, 0).asDiagonal();
  const Eigen::MatrixXd measured = Eigen::Vector3d(8, 2, 0).asDiagonal();
  const Eigen::MatrixXd excess = CovarianceExcess(measured, counted, covariance);
  const Eigen::MatrixXd expected = Eigen::Vector3d(5, 0, 0).asDiagonal();
  EXPECT_LT((excess - expected).norm(), 1e-12);
}

TEST(CovarianceExcess, WhatIsAsLargeAsCountedOnAddsNothing) {
  Eigen::Matrix2d covariance;
  covariance << 2, 0.6, 0.6, 1;
  EXPECT_LT(CovarianceExcess(0.7 * covariance, 0.7 * covariance, covariance).norm(), 1e-12);
}

// The same in other units: parameters = map * old ones.
TEST(CovarianceExcess, DoesNotDependOnTheUnits) {
  Eigen::Matrix2d covariance, counted, measured, map;
  covariance << 2, 0.6, 0.6, 1;
  counted << 1, 0.2, 0.2, 0.5;
  measured << 3, -0.4, -0.4, 0.1;
  map << 100, 3, 0, 0.01;
  const auto in_units = [&](const Eigen::MatrixXd& of) -> Eigen::MatrixXd {
    return map * of * map.transpose();
  };
  const Eigen::MatrixXd excess = CovarianceExcess(measured, counted, covariance);
  EXPECT_GT(excess.norm(), 1);
  EXPECT_LT((in_units(excess) -
             CovarianceExcess(in_units(measured), in_units(counted), in_units(covariance)))
                .norm(),
            1e-9 * in_units(excess).norm());
}

}  // namespace
}  // namespace groundglass
