// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/select/seams.h"

#include "tests/invrender/select/made_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace groundglass {
namespace {

ChartChoice Trusting(const ChartBlocks& blocks, std::vector<int> best) {
  return {std::move(best), std::vector<float>(blocks.views.size(), 1)};
}

// An island of one block in a row has two sides of seam, 0.15 each; to give it up costs the
// logarithm of what is lost.
std::vector<int> SmoothIsland(float island_quality, const SeamOptions& options = {}) {
  ChartBlocks blocks = MakeBlocks(5, 1, 2);
  ViewAt(blocks, 2, 0, 1).quality = island_quality;
  for (const int x : {0, 1, 3, 4}) ViewAt(blocks, x, 0, 1).quality = 1e-6f;
  ChartChoice choice = Trusting(blocks, {0, 0, 1, 0, 0});
  SmoothSeams(blocks, 0, Neutral(blocks), options, choice);
  return choice.best;
}

TEST(SmoothSeams, DropsIslandsThatGainLessThanTheirSeams) {
  EXPECT_EQ(SmoothIsland(std::exp(0.29f)), std::vector<int>(5, 0));
  EXPECT_EQ(SmoothIsland(std::exp(0.31f)), (std::vector<int>{0, 0, 1, 0, 0}));
}

TEST(SmoothSeams, CostlierSeamsDropLargerIslands) {
  SeamOptions options;
  options.seam_cost = 0.5;
  EXPECT_EQ(SmoothIsland(std::exp(0.9f), options), std::vector<int>(5, 0));
  EXPECT_EQ(SmoothIsland(std::exp(1.1f), options), (std::vector<int>{0, 0, 1, 0, 0}));
}

// The first photograph sees the left end, the second the right one, and in the middle both look
// alike in one place only.
TEST(SmoothSeams, MoveToWhereBothLookAlike) {
  ChartBlocks blocks = MakeBlocks(8, 1, 2);
  ViewAt(blocks, 0, 0, 1).quality = 0;
  ViewAt(blocks, 7, 0, 0).quality = 0;
  for (const int x : {1, 2, 3, 4}) {
    ViewAt(blocks, x, 0, 1).log_radiance += 0.8f;
  }
  ChartChoice choice = Trusting(blocks, {0, 0, 0, 1, 1, 1, 1, 1});
  SmoothSeams(blocks, 0, Neutral(blocks), {}, choice);
  EXPECT_EQ(choice.best, (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 1}));
}

TEST(SmoothSeams, NeverTakesAPhotographThatDoesNotSeeABlock) {
  ChartBlocks blocks = MakeBlocks(3, 3, 2);
  ViewAt(blocks, 1, 1, 0).quality = 0;
  ViewAt(blocks, 2, 2, 0).quality = 0;
  ViewAt(blocks, 2, 2, 1).quality = 0;
  ChartChoice choice = Trusting(blocks, {0, 0, 0, 0, 1, 0, 0, 0, -1});
  SmoothSeams(blocks, 0, Neutral(blocks), {}, choice);
  EXPECT_EQ(choice.best[4], 1);
  EXPECT_EQ(choice.best[8], -1);
}

TEST(SmoothSeams, LeavesAPhotographAloneAsItIs) {
  const ChartBlocks blocks = MakeBlocks(2, 1, 1);
  ChartChoice choice = Trusting(blocks, {0, -1});
  SmoothSeams(blocks, 0, Neutral(blocks), {}, choice);
  EXPECT_EQ(choice.best, (std::vector<int>{0, -1}));
}

}  // namespace
}  // namespace groundglass
