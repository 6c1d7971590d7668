// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

TEST(FilteredLines, IsOneOnALineAndTheShareOfLineOverAPeriod) {
  EXPECT_NEAR(FilteredLines(10, 1e-3, 5, 0.2), 1, 1e-9);
  EXPECT_NEAR(FilteredLines(12.5, 1e-3, 5, 0.2), 0, 1e-9);
  EXPECT_NEAR(FilteredLines(10.1, 0.1, 5, 0.2), 0.5, 1e-12);  // half on the line's right border
  EXPECT_NEAR(FilteredLines(-7.3, 5, 5, 0.2), 0.04, 1e-12);
}

TEST(FilteredInterval, IsTheOverlappingShare) {
  EXPECT_DOUBLE_EQ(FilteredInterval(1, 1, 1, 3), 0.5);
  EXPECT_DOUBLE_EQ(FilteredInterval(2, 10, 1, 3), 0.2);
  EXPECT_DOUBLE_EQ(FilteredInterval(9, 1, 1, 3), 0);
}

TEST(FilteredNoise, VanishesWhereItsPeriodsAreSmallerThanTheFootprint) {
  EXPECT_NE(FilteredNoise(1, 3.3, 4.4, 1, 3, 0.01, 0.01), 0);
  EXPECT_EQ(FilteredNoise(1, 3.3, 4.4, 1, 3, 0.6, 0.01), 0);
}

TEST(NormalOf, HasZeroMeanAndUnitDeviation) {
  double sum = 0;
  double squares = 0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double value = NormalOf(HashOf(7, i));
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0, 0.03);
  EXPECT_NEAR(std::sqrt(squares / kCount), 1, 0.03);
}

}  // namespace
}  // namespace groundglass
