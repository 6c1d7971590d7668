// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/reduce.h"

#include "scene/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

TEST(ReducedInLight, AveragesLightAndNotItsCodes) {
  Image8 stripes(8, 6, 3);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      for (int c = 0; c < 3; ++c) stripes.At(x, y)[c] = x % 2 == 0 ? 0 : 255;
    }
  }
  const Image8 reduced = ReducedInLight(stripes, 4, 3);
  ASSERT_EQ(reduced.width, 4);
  ASSERT_EQ(reduced.height, 3);
  // Half the light is code 188; the codes' mean would be 128.
  for (const uint8_t code : reduced.values) EXPECT_EQ(code, 188);
}

TEST(ReducedInLight, KeepsAnEvenPictureAtAnySize) {
  const Image8 even(97, 61, 1, 141);
  for (const auto& [width, height] :
       {std::pair(1, 1), {96, 60}, {50, 61}, {97, 17}, {33, 7}, {97, 61}}) {
    const Image8 reduced = ReducedInLight(even, width, height);
    ASSERT_EQ(reduced.values.size(), static_cast<size_t>(width) * height);
    for (const uint8_t code : reduced.values) EXPECT_EQ(code, 141) << width << " " << height;
  }
}

TEST(ReducedInLight, SharesPixelsThatStraddleABorder) {
  // Three pixels into two: the middle one belongs half to each.
  Image8 row(3, 1, 1);
  row.values = {0, 255, 255};
  const Image8 reduced = ReducedInLight(row, 2, 1);
  EXPECT_EQ(reduced.values[0], static_cast<uint8_t>(std::lround(255 * SrgbFromLinear(1.0f / 3))));
  EXPECT_EQ(reduced.values[1], 255);
}

// The same picture through fewer pixels: the light that is in it stays.
TEST(ReducedInLight, KeepsTheLightOfTheWhole) {
  Image8 ramp(240, 100, 1);
  double light = 0;
  for (int y = 0; y < ramp.height; ++y) {
    for (int x = 0; x < ramp.width; ++x) {
      *ramp.At(x, y) = static_cast<uint8_t>((x + y) % 256);
      light += LinearFromSrgb(static_cast<float>(*ramp.At(x, y)) / 255);
    }
  }
  const Image8 reduced = ReducedInLight(ramp, 101, 43);
  double left = 0;
  for (const uint8_t code : reduced.values) left += LinearFromSrgb(static_cast<float>(code) / 255);
  EXPECT_NEAR(left / reduced.values.size(), light / ramp.values.size(), 1e-3);
}

}  // namespace
}  // namespace groundglass
