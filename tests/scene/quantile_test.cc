// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/quantile.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(ValueOfRank, CountsFromTheSmallest) {
  const std::vector<int> values = {5, 1, 4, 1, 3};
  EXPECT_EQ(ValueOfRank(values, 0), 1);
  EXPECT_EQ(ValueOfRank(values, 2), 3);
  EXPECT_EQ(ValueOfRank(values, 4), 5);
}

TEST(UpperMedian, IsTheHigherOfTheTwoInTheMiddle) {
  EXPECT_EQ(UpperMedian(std::vector<double>{2.5}), 2.5);
  EXPECT_EQ(UpperMedian(std::vector<double>{9, 1, 2}), 2);
  EXPECT_EQ(UpperMedian(std::vector<double>{4, 1, 3, 2}), 3);
}

}  // namespace
}  // namespace groundglass
