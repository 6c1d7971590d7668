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

TEST(WhyNoNumber, WhatPeopleWriteIsTurnedIntoNumbers) {
  const auto says = [](const char* word, const char* advice) {
    EXPECT_EQ(WhyNoNumber(word), std::string("'") + word + "' is not a number; " + advice);
  };
  says("22'-2.4\"", "feet and inches are written with decimals: 22.2 ft");
  says("-74' 10\"", "feet and inches are written with decimals: -74.8333 ft");
  says("6\"", "feet and inches are written with decimals: 0.5 ft");
  says("5\u20323", "feet and inches are written with decimals: 5.25 ft");
  says("54\u00B030'", "write 54.5");
  says("54\u00B030'36\"", "write 54.51");
  says("22.2 \u00B1 0.5",
       "write 22.2 alone, and how sure it is under sigma_position, sigma_lookat and the like");
  says("22.2?", "write 22.2 alone, without '?'");
  says("36x24", "write 1.5");
  says("3\u00D72", "write 1.5");
  says("1,022.2", "write 1022.2");
  says("1.234.567,5", "write 1234567.5");
  says("#REF!", "a spreadsheet's error: look up what was written");
  says("=B2+1", "a spreadsheet's formula: save the table with its values");
  says("6.77 m", "write 6.77 alone, if the model is in m too, or else what that is in its unit");
}

TEST(WhyNoNumber, WhatIsNoneStaysWithoutAdvice) {
  for (const char* word : {"wide", "0x16", "1,22.5", "12,34,5.6", "-", "x", "'", "+-", "1'2'3"}) {
    EXPECT_EQ(WhyNoNumber(word), std::string("'") + word + "' is not a number");
  }
}

}  // namespace
}  // namespace groundglass
