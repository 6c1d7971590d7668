// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/select/choose.h"

#include "tests/invrender/select/made_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace groundglass {
namespace {

// Nothing but each block's own difference.
ConsistencyOptions BlockByBlock() {
  ConsistencyOptions options;
  options.cost_radius = 0;
  options.inconsistency_radius = 0;
  options.consensus_radius = 0;
  return options;
}

TEST(MeasureConsistency, IsOneForAPhotographAlone) {
  const ChartBlocks blocks = MakeBlocks(3, 2, 1);
  EXPECT_EQ(MeasureConsistency(blocks, 0, Neutral(blocks), {}), std::vector<float>(6, 1));
}

TEST(MeasureConsistency, IsOneWhereAllAgree) {
  const ChartBlocks blocks = MakeBlocks(3, 2, 3);
  EXPECT_EQ(MeasureConsistency(blocks, 0, Neutral(blocks), {}), std::vector<float>(18, 1));
}

// Twice the ordinary difference in all channels is an inconsistency of 4.
TEST(MeasureConsistency, FallsWithTheSquaredDifferenceToTheMajority) {
  const ConsistencyOptions options = BlockByBlock();
  ChartBlocks blocks = MakeBlocks(1, 1, 3);
  ViewAt(blocks, 0, 0, 1).log_radiance += 2 * options.ordinary_difference;
  const std::vector<float> consistency = MeasureConsistency(blocks, 0, Neutral(blocks), options);
  EXPECT_EQ(consistency[0], 1);
  EXPECT_NEAR(consistency[1], std::exp(-4.0), 1e-5);
  EXPECT_EQ(consistency[2], 1);
}

TEST(MeasureConsistency, InconsistencyHasAnEnd) {
  ConsistencyOptions options = BlockByBlock();
  options.max_inconsistency = 2;
  ChartBlocks blocks = MakeBlocks(1, 1, 3);
  ViewAt(blocks, 0, 0, 0).log_radiance += 5;
  const std::vector<float> consistency = MeasureConsistency(blocks, 0, Neutral(blocks), options);
  EXPECT_NEAR(consistency[0], std::exp(-2.0), 1e-6);
}

TEST(MeasureConsistency, UnevenLightCostsEverywhere) {
  ConsistencyOptions options = BlockByBlock();
  options.even_light_preference = 3;
  const ChartBlocks blocks = MakeBlocks(2, 1, 2);
  ColourModel colour = Neutral(blocks);
  colour.photos[1].nonuniformity = 0.5;
  const std::vector<float> consistency = MeasureConsistency(blocks, 0, colour, options);
  EXPECT_EQ(consistency[0], 1);
  EXPECT_NEAR(consistency[1], std::exp(-1.5), 1e-6);
  EXPECT_EQ(consistency[2], 1);
}

// Of two that differ, the one whose colour the chart has elsewhere is believed.
TEST(MeasureConsistency, TheHistogramDecidesBetweenTwo) {
  const ConsistencyOptions options = BlockByBlock();
  ChartBlocks blocks = MakeBlocks(20, 10, 2);
  ViewAt(blocks, 7, 4, 0).log_radiance = Eigen::Array3f(-0.2f, -3, -3);
  const std::vector<float> consistency = MeasureConsistency(blocks, 0, Neutral(blocks), options);
  const size_t at = 2 * (4 * 20 + 7);
  EXPECT_LT(consistency[at], 0.001);
  EXPECT_EQ(consistency[at + 1], 1);
}

// Three that show three things: all inconsistency counts a quarter, also for those who differ most.
TEST(MeasureConsistency, WithoutAMajorityInconsistencyCountsLittle) {
  ConsistencyOptions options = BlockByBlock();
  options.histogram_weight = 0;
  ChartBlocks blocks = MakeBlocks(2, 1, 3);
  for (int x = 0; x < 2; ++x) {
    ViewAt(blocks, x, 0, 0).log_radiance += 2 * options.ordinary_difference;
    ViewAt(blocks, x, 0, 2).log_radiance -= 2 * options.ordinary_difference;
  }
  const std::vector<float> consistency = MeasureConsistency(blocks, 0, Neutral(blocks), options);
  for (int x = 0; x < 2; ++x) {
    EXPECT_NEAR(consistency[3 * x], std::exp(-1.0), 1e-5);
    EXPECT_EQ(consistency[3 * x + 1], 1);
    EXPECT_NEAR(consistency[3 * x + 2], std::exp(-1.0), 1e-5);
  }
}

TEST(PreferSharp, LowersBlurredOnesWhereThreeLook) {
  ChartBlocks blocks = MakeBlocks(2, 1, 3);
  ViewAt(blocks, 1, 0, 2).quality = 0;  // two look at the second block
  std::vector<Sharpness> sharpness(3);
  sharpness[0].factor = 0.5;
  std::vector<float> consistency(6, 1);
  PreferSharp(blocks, sharpness, {}, consistency);
  EXPECT_EQ(consistency, (std::vector<float>{0.5f, 1, 1, 1, 1, 1}));
  ConsistencyOptions of_two;
  of_two.fewest_to_compare = 2;
  PreferSharp(blocks, sharpness, of_two, consistency);
  EXPECT_EQ(consistency, (std::vector<float>{0.25f, 1, 1, 0.5f, 1, 1}));
}

TEST(ChooseBlocks, TakesTheBestProductAndTheFirstOfEquals) {
  ChartBlocks blocks = MakeBlocks(4, 1, 2);
  ViewAt(blocks, 1, 0, 1).quality = 2;
  ViewAt(blocks, 2, 0, 1).quality = 2;
  ViewAt(blocks, 3, 0, 0).quality = 0;
  ViewAt(blocks, 3, 0, 1).quality = 0;
  std::vector<float> consistency(8, 1);
  consistency[2 * 2 + 1] = 0.25f;
  const ChartChoice choice = ChooseBlocks(blocks, consistency);
  EXPECT_EQ(choice.best, (std::vector<int>{0, 1, 0, -1}));
  EXPECT_EQ(choice.consistency, consistency);
}

}  // namespace
}  // namespace groundglass
