// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/text.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(FormatNumber, WritesNumbersAsPeopleDo) {
  EXPECT_EQ(FormatNumber(500000), "500000");
  EXPECT_EQ(FormatNumber(-5412345.25), "-5412345.25");
  EXPECT_EQ(FormatNumber(0.1), "0.1");
  EXPECT_EQ(FormatNumber(0), "0");
}

TEST(FormatNumber, LosesNoBit) {
  for (const double value : {1.0 / 3, 4e5 / 3, 1e15, 1.7976931348623157e308, 5e-324, -1e-7}) {
    EXPECT_EQ(ParseNumber(FormatNumber(value)), value);
  }
}

TEST(WhyNoNumber, NoAdviceChangesWhatWasMeant) {
  EXPECT_EQ(WhyNoNumber("1.4D+01"), "'1.4D+01' is not a number; write 1.4E+01");
  EXPECT_EQ(WhyNoNumber("137'"), "'137'' is not a number; write feet with decimals: 3' 6\" is 3.5");
  EXPECT_EQ(WhyNoNumber("05. Jan"),
            "'05. Jan' is not a number; a spreadsheet has made a date of it: look up what was "
            "written");
}

}  // namespace
}  // namespace groundglass
