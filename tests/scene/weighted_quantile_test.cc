// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/weighted_quantile.h"

#include <gtest/gtest.h>

#include <vector>

namespace groundglass {
namespace {

TEST(WeightedQuantile, IsTheSmallestValueWithTheShareOfTheWeightAtOrBelowIt) {
  std::vector<WeightedValue<double>> values = {{7, 1}, {2, 4}, {5, 3}, {3, 2}};
  // Below 2, 3, 5 and 7 there lie 4, 6, 9 and 10 of 10.
  EXPECT_EQ(WeightedQuantile(values, 0, 0.0), 2);
  EXPECT_EQ(WeightedQuantile(values, 0.4, 0.0), 2);
  EXPECT_EQ(WeightedQuantile(values, 0.41, 0.0), 3);
  EXPECT_EQ(WeightedQuantile(values, 0.9, 0.0), 5);
  EXPECT_EQ(WeightedQuantile(values, 0.91, 0.0), 7);
  EXPECT_EQ(WeightedQuantile(values, 1, 0.0), 7);
}

TEST(WeightedMedian, IsTheLowerOfTwoThatHaveHalfTheWeightEach) {
  std::vector<WeightedValue<float>> values = {{4, 2}, {1, 2}};
  EXPECT_EQ(WeightedMedian(values, 0.0f), 1);
  values = {{4, 2.5f}, {1, 2}};
  EXPECT_EQ(WeightedMedian(values, 0.0f), 4);
}

TEST(WeightedMedian, OfNoneIsWhatTheCallerSays) {
  std::vector<WeightedValue<double>> none;
  EXPECT_EQ(WeightedMedian(none, -3.0), -3);
}

}  // namespace
}  // namespace groundglass
