// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/srgb.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(Srgb, KnownCodesHaveTheStandardsLight) {
  EXPECT_EQ(LinearOfSrgb8()[0], 0);
  EXPECT_EQ(LinearOfSrgb8()[255], 1);
  // IEC 61966-2-1: 10 is still on the straight part, 10 / 255 / 12.92.
  EXPECT_NEAR(LinearOfSrgb8()[10], 0.003035270, 2e-7);
  EXPECT_NEAR(LinearOfSrgb8()[188], 0.502886458, 2e-7);
}

TEST(Srgb, EveryCodeComesBackAndWhatLiesBetweenGoesToTheNearest) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(Srgb8FromLinear(LinearOfSrgb8()[static_cast<size_t>(code)]), code);
    if (code == 255) continue;
    EXPECT_EQ(Srgb8FromLinear(LinearFromSrgb((static_cast<float>(code) + 0.4f) / 255)), code);
    EXPECT_EQ(Srgb8FromLinear(LinearFromSrgb((static_cast<float>(code) + 0.6f) / 255)), code + 1);
  }
  EXPECT_EQ(Srgb8FromLinear(-1), 0);
  EXPECT_EQ(Srgb8FromLinear(7), 255);
}

}  // namespace
}  // namespace groundglass
