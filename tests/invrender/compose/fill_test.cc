// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/compose/fill.h"

#include "tests/invrender/compose/made_pixels.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace groundglass {
namespace {

const std::vector<std::string> kHole = {
    "gggggggg",
    "gggggggg",
    "gg...ggg",
    "gg...ggg",
    "gggggggg",
    "gggggg  ",
};

TEST(FillOpenTexels, PaintsHolesFromAroundAndSaysSo) {
  ChartPixels pixels = MakePixels(kHole, 120);
  FillOpenTexels({}, pixels);
  for (int y = 2; y < 4; ++y) {
    for (int x = 2; x < 5; ++x) {
      EXPECT_NEAR(*pixels.srgb8.At(x, y), 120, 1);
      EXPECT_EQ(*pixels.provenance.At(x, y), kProvenanceFilled);
    }
  }
  EXPECT_EQ(StatesOf(pixels)[2], "ggwwwggg");
  EXPECT_EQ(*pixels.srgb8.At(0, 0), 120);
  EXPECT_EQ(*pixels.provenance.At(0, 0), 1);
  // Outside the faces nothing is claimed.
  EXPECT_EQ(*pixels.provenance.At(7, 5), kProvenanceNone);
  EXPECT_EQ(StatesOf(pixels)[5], "gggggg  ");
}

TEST(FillOpenTexels, DoesTheSameWithSixteenBits) {
  ChartPixels pixels = MakePixels(kHole, 120);
  pixels.srgb16 = Image16(pixels.srgb8.width, pixels.srgb8.height, 3);
  for (size_t i = 0; i < pixels.srgb8.values.size(); ++i) {
    pixels.srgb16.values[i] = static_cast<uint16_t>(257 * pixels.srgb8.values[i]);
  }
  pixels.srgb8 = Image8();
  FillOpenTexels({}, pixels);
  EXPECT_NEAR(*pixels.srgb16.At(3, 3), 257 * 120, 257);
  EXPECT_EQ(*pixels.srgb16.At(0, 0), 257 * 120);
  EXPECT_EQ(*pixels.provenance.At(3, 3), kProvenanceFilled);
}

TEST(FillOpenTexels, LeavesWhatHasNothingToStartFrom) {
  ChartPixels pixels = MakePixels({"...", " . "});
  FillOpenTexels({}, pixels);
  EXPECT_EQ(StatesOf(pixels), (std::vector<std::string>{"...", " . "}));
  EXPECT_EQ(*pixels.provenance.At(1, 0), kProvenanceNone);
}

TEST(FillOpenTexels, LeavesAChartWithoutHolesAsItIs) {
  ChartPixels pixels = MakePixels({"gwg", "g g"});
  const ChartPixels before = pixels;
  FillOpenTexels({}, pixels);
  EXPECT_EQ(pixels.srgb8.values, before.srgb8.values);
  EXPECT_EQ(pixels.provenance.values, before.provenance.values);
}

}  // namespace
}  // namespace groundglass
