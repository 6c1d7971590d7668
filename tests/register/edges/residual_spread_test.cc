// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/residual_spread.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

TEST(ResidualSpread, IsTheWeightedRootMeanSquareAndTheScaledMedian) {
  const ResidualSpread spread = MeasureSpread({{1, 2}, {-2, 1}, {4, 1}});
  EXPECT_DOUBLE_EQ(spread.rms_px, std::sqrt((2 * 1 + 4 + 16) / 4.0));
  EXPECT_DOUBLE_EQ(spread.robust_sigma_px, 1.4826);  // half the weight lies at 1
}

// Nothing holds them up or down: neither a good photograph's nor a bad one's.
TEST(ResidualSpread, IsNotClamped) {
  EXPECT_DOUBLE_EQ(MeasureSpread({{0.01, 1}, {-0.01, 1}}).rms_px, 0.01);
  EXPECT_DOUBLE_EQ(MeasureSpread({{0.01, 1}, {-0.01, 1}}).robust_sigma_px, 0.014826);
  EXPECT_DOUBLE_EQ(MeasureSpread({{50, 1}, {-50, 1}}).rms_px, 50);
}

TEST(ResidualSpread, OneFarResidualMovesTheRootMeanSquareAlone) {
  std::vector<WeightedValue<double>> residuals(99, {0.2, 1});
  residuals.push_back({20, 1});
  const ResidualSpread spread = MeasureSpread(residuals);
  EXPECT_NEAR(spread.rms_px, 2.01, 0.01);
  EXPECT_NEAR(spread.robust_sigma_px, 0.2965, 1e-3);
}

}  // namespace
}  // namespace groundglass
