// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/hash.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

// The first numbers of SplitMix64 from the seed 1234567, as its authors' program prints them.
TEST(HashOf, IsSplitMix64) {
  constexpr uint64_t kStep = 0x9e3779b97f4a7c15u;
  EXPECT_EQ(HashOf(1234567), 6457827717110365317u);
  EXPECT_EQ(HashOf(1234567 + kStep), 3203168211198807973u);
  EXPECT_EQ(HashOf(1234567 + 2 * kStep), 9817491932198370423u);
}

}  // namespace
}  // namespace groundglass
