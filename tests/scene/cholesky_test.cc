// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/cholesky.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(Cholesky, InvertsAndFactors) {
  Eigen::Matrix3d matrix;
  matrix << 4, 2, 0, 2, 5, 1, 0, 1, 3;
  const auto inverse = InvertByCholesky(matrix);
  ASSERT_TRUE(inverse);
  EXPECT_TRUE((*inverse * matrix).isIdentity(1e-12));
  const Eigen::MatrixXd upper = UpperCholeskyFactor(matrix).value();
  EXPECT_TRUE((upper.transpose() * upper).isApprox(matrix, 1e-12));
  EXPECT_EQ(upper(2, 0), 0);
}

TEST(Cholesky, HasNothingOfWhatIsNotPositiveDefinite) {
  const Eigen::MatrixXd saddle = Eigen::Vector2d(1, -1).asDiagonal();
  EXPECT_FALSE(InvertByCholesky(saddle));
  EXPECT_FALSE(UpperCholeskyFactor(saddle));
}

}  // namespace
}  // namespace groundglass
