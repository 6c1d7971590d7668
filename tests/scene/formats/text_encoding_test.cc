// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/text_encoding.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(DisplayWidth, CountsColumnsAndNotBytes) {
  EXPECT_EQ(DisplayWidth("S\xC3\xBC"
                         "d"),
            3);  // ü as one letter
  EXPECT_EQ(DisplayWidth("Su\xCC\x88"
                         "d"),
            3);                                // u and its dots
  EXPECT_EQ(DisplayWidth("\xE6\x9D\xB1"), 2);  // a wide letter
  EXPECT_EQ(DisplayWidth("S\xFC"
                         "d"),
            3);  // a byte that is no letter
}

TEST(PaddedTo, FillsColumnsAndCutsNothing) {
  EXPECT_EQ(PaddedTo(5,
                     "S\xC3\xBC"
                     "d"),
            "S\xC3\xBC"
            "d  ");
  EXPECT_EQ(PaddedTo(2, "south"), "south");
}

}  // namespace
}  // namespace groundglass
