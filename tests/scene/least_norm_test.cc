// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/least_norm.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(SolveLeastNorm, GivesTheShortestOfManySolutions) {
  Eigen::MatrixXd matrix(1, 2);
  matrix << 3, 4;
  const Eigen::MatrixXd solution = SolveLeastNorm(matrix, Eigen::MatrixXd::Constant(1, 1, 25));
  EXPECT_TRUE(solution.isApprox(Eigen::Vector2d(3, 4), 1e-12)) << solution;
}

TEST(SolveLeastNorm, LeavesAParameterAtZeroThatNothingMoves) {
  // The second column is zero, as a locked parameter's is; three rows say 1, 2 and 3 of the first.
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3, 2);
  matrix.col(0).setOnes();
  const Eigen::MatrixXd solution = SolveLeastNorm(matrix, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(solution(0), 2, 1e-12);
  EXPECT_EQ(solution(1), 0);
}

}  // namespace
}  // namespace groundglass
