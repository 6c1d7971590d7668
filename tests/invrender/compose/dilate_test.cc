// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/compose/dilate.h"

#include "tests/invrender/compose/made_pixels.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace groundglass {
namespace {

void SetTexel(ChartPixels& pixels, int x, int y, uint8_t grey, uint16_t source) {
  std::fill_n(pixels.srgb8.At(x, y), 3, grey);
  *pixels.provenance.At(x, y) = source;
}

TEST(InpaintBorders, WeakTexelsTakeTheColourOfGoodOnesWithinTheirReach) {
  ChartPixels pixels = MakePixels({"gwww"});
  SetTexel(pixels, 0, 0, 40, 7);
  for (int x = 1; x < 4; ++x) *pixels.reach.At(x, 0) = 2;
  InpaintBorders(pixels);
  for (const int x : {0, 1, 2}) {
    EXPECT_EQ(*pixels.srgb8.At(x, 0), 40) << x;
    EXPECT_EQ(*pixels.provenance.At(x, 0), 7) << x;
  }
  EXPECT_EQ(*pixels.srgb8.At(3, 0), 100);  // three away
  EXPECT_EQ(*pixels.provenance.At(3, 0), 1);
}

TEST(InpaintBorders, ATexelTakesTheRoundedMeanOfItsNeighbours) {
  ChartPixels pixels = MakePixels({"gwg"});
  SetTexel(pixels, 0, 0, 40, 7);
  SetTexel(pixels, 2, 0, 45, 8);
  *pixels.reach.At(1, 0) = 1;
  InpaintBorders(pixels);
  EXPECT_EQ(*pixels.srgb8.At(1, 0), 43);
  EXPECT_EQ(*pixels.provenance.At(1, 0), 7);  // the first one's
}

TEST(InpaintBorders, LeavesOpenTexelsAndGoodOnesAlone) {
  ChartPixels pixels = MakePixels({"g.g ", "wwww"});
  const ChartPixels before = pixels;
  InpaintBorders(pixels);  // reaches are 0
  EXPECT_EQ(pixels.srgb8.values, before.srgb8.values);
  EXPECT_EQ(pixels.provenance.values, before.provenance.values);
}

TEST(CloseHoles, FillsSlitsAndLeavesWiderGaps) {
  ChartPixels pixels = MakePixels({"g...g", "g...g"});
  CloseHoles({}, pixels);
  EXPECT_EQ(StatesOf(pixels), (std::vector<std::string>{"gwwwg", "gwwwg"}));
  EXPECT_EQ(*pixels.srgb8.At(2, 0), 100);
  EXPECT_EQ(*pixels.provenance.At(2, 0), kProvenanceFilled);
  EXPECT_EQ(*pixels.provenance.At(0, 0), 1);

  // Nine wide: beyond three texels neither side is in reach of the other, up and down it is open.
  const std::vector<std::string> wide(9, "g.........g");
  ChartPixels open = MakePixels(wide);
  CloseHoles({}, open);
  EXPECT_EQ(StatesOf(open)[4], wide[4]);
}

TEST(CloseHoles, WiderSlitsIfAskedTo) {
  const std::vector<std::string> gap(20, "g.....g");
  ChartPixels pixels = MakePixels(gap);
  CloseHoles({.slit_texels = 2}, pixels);
  EXPECT_EQ(StatesOf(pixels)[10], "g.....g");
  CloseHoles({.slit_texels = 5}, pixels);
  EXPECT_EQ(StatesOf(pixels)[10], "gwwwwwg");
}

// An open strip between the chart's end and a covered texel is a slit; open faces alone are none.
TEST(CloseHoles, NeedsACoveredTexelOnOneSideAtLeast) {
  ChartPixels strip = MakePixels({".g"});
  CloseHoles({}, strip);
  EXPECT_EQ(StatesOf(strip), (std::vector<std::string>{"wg"}));
  ChartPixels alone = MakePixels({" .. "});
  CloseHoles({}, alone);
  EXPECT_EQ(StatesOf(alone), (std::vector<std::string>{" .. "}));
}

TEST(PlaceOnPage, RepeatsTheBorderInTheGutterOnly) {
  ChartPixels pixels = MakePixels({"g.", "gg"});
  Chart chart;
  chart.width_texels = 2;
  chart.height_texels = 2;
  chart.page = 0;
  chart.x_on_page = 3;
  chart.y_on_page = 2;
  TexturePage page;
  page.srgb8 = Image8(8, 7, 3);
  page.provenance = Image16(8, 7, 1);
  PlaceOnPage(chart, pixels, 2, page);
  EXPECT_EQ(*page.srgb8.At(3, 2), 100);
  EXPECT_EQ(*page.srgb8.At(4, 2), kNoPhotographSrgb8);  // open
  EXPECT_EQ(*page.provenance.At(4, 2), kProvenanceNone);
  EXPECT_EQ(*page.srgb8.At(1, 0), 100);  // the gutter's corner
  EXPECT_EQ(*page.srgb8.At(6, 5), 100);
  EXPECT_EQ(*page.srgb8.At(6, 0), kNoPhotographSrgb8);
  EXPECT_EQ(*page.provenance.At(1, 0), kProvenanceNone);
  EXPECT_EQ(*page.srgb8.At(0, 0), 0);  // beyond it
  EXPECT_EQ(*page.srgb8.At(7, 6), 0);
}

}  // namespace
}  // namespace groundglass
