// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/measure/texel_blocks.h"

#include "tests/invrender/prepared_wall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace groundglass {
namespace {

// A camera on the wall's back.
Camera CameraBehind() { return LookAt({4, 10, 2}, {4, 0, 2}, 200, 100, 200); }

TEST(FindPhotosOfChart, LeavesOutWhoFacesItsBackOrLooksElsewhere) {
  const PreparedWall wall({CameraBefore(4), CameraBehind(), CameraBefore(40), CameraBefore(1)},
                          {0.2f, 0.2f, 0.2f, 0.2f});
  EXPECT_EQ(FindPhotosOfChart(wall.charts[0], 0, wall.photos), (std::vector<int>{0, 3}));
}

TEST(ObserveBlocks, GivesEachBlockItsColourInEachPhotograph) {
  const PreparedWall wall({CameraBefore(4), CameraBefore(4.5)}, {0.2f, 0.4f});
  const std::vector<ChartBlocks> blocks = ObserveBlocks(wall.model, wall.charts, wall.photos, {});
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].width, 13);  // of 64 x 32 texels, five a side
  EXPECT_EQ(blocks[0].height, 7);
  EXPECT_EQ(blocks[0].photos, (std::vector<int>{0, 1}));
  const BlockView* middle = blocks[0].ViewsOf(3 * 13 + 6);
  EXPECT_NEAR(middle[0].log_radiance[1], std::log(0.2), 0.02);
  EXPECT_NEAR(middle[1].log_radiance[1], std::log(0.4), 0.02);
  for (int k = 0; k < 2; ++k) {
    EXPECT_TRUE(middle[k].is_usable);
    EXPECT_NEAR(middle[k].quality, 20, 0.1);  // px for one unit
    EXPECT_LT(middle[k].radius_squared, 0.02f);
  }
}

TEST(ObserveBlocks, AreNotUsableAtBordersOrWhereBurntOutOrBlack) {
  const PreparedWall wall({CameraBefore(4), CameraBefore(4), CameraBefore(4)},
                          {0.2f, 0.99f, 0.0005f});
  const std::vector<ChartBlocks> blocks = ObserveBlocks(wall.model, wall.charts, wall.photos, {});
  const BlockView* middle = blocks[0].ViewsOf(3 * 13 + 6);
  EXPECT_TRUE(middle[0].is_usable);
  EXPECT_FALSE(middle[1].is_usable);
  EXPECT_FALSE(middle[2].is_usable);
  EXPECT_GT(middle[1].quality, 0);  // seen all the same
  // The last row of blocks has two rows of texels, its middle 1.9 px from the wall's edge at most.
  EXPECT_LT(blocks[0].ViewsOf(6 * 13 + 6)[0].quality, middle[0].quality);
}

TEST(ObserveBlocks, WhatLiesOutsideThePictureIsNotSeen) {
  const PreparedWall wall({CameraBefore(4), CameraBefore(-1)}, {0.2f, 0.2f});
  const std::vector<ChartBlocks> blocks = ObserveBlocks(wall.model, wall.charts, wall.photos, {});
  // The second sees the wall up to 4.
  EXPECT_GT(blocks[0].ViewsOf(3 * 13 + 2)[1].quality, 0);
  EXPECT_EQ(blocks[0].ViewsOf(3 * 13 + 10)[1].quality, 0);
  EXPECT_GT(blocks[0].ViewsOf(3 * 13 + 10)[0].quality, 0);
}

TEST(ObserveBlocks, ChartsWithoutAPageStayEmpty) {
  PreparedWall wall({CameraBefore(4)}, {0.2f});
  wall.charts[0].page = -1;
  const std::vector<ChartBlocks> blocks = ObserveBlocks(wall.model, wall.charts, wall.photos, {});
  EXPECT_EQ(blocks[0].NumBlocks(), 0);
  EXPECT_TRUE(blocks[0].photos.empty());
}

}  // namespace
}  // namespace groundglass
