// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/pins_file.h"

#include "register/register.h"
#include "scene/frames.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::HasSubstr;

Pins FourAndALine() {
  Pins pins;
  pins.points = {{{1, 2, 3}, {10.5, 20.25}, 2, PinUse::kUsed},
                 {{4, 0, 6}, {0.1, 1.0 / 3}, 1.5, PinUse::kUsed},
                 {{7, 8, 9}, {50, 60}, 2, PinUse::kUsed},
                 {{7, 8, 10}, {52, 60}, 2, PinUse::kCheck}};
  pins.lines = {{{0, 0, 0}, {0, 0, 5}, {3, 4}, {5, 6.5}, 2, PinUse::kOff}};
  return pins;
}

TEST(PinsFile, ComesBackToTheLastBit) {
  const std::string text = ReplacePins("", "s5", FourAndALine());
  EXPECT_EQ(ParsePins(text, "pins.points").at("s5"), FourAndALine());
}

TEST(PinsFile, RegisterReadsThePointsThatAreUsed) {
  const TemporaryFolder folder;
  Pins few = FourAndALine();
  few.points.resize(2);
  const std::string text = ReplacePins(ReplacePins("", "s5", FourAndALine()), "s6", few);
  const auto points = ReadControlPoints(folder.Write("pins.points", text));
  ASSERT_EQ(points.size(), 3u) << text;
  EXPECT_EQ(points[1].photograph, "s5");
  EXPECT_EQ(points[1].point_in_world, Eigen::Vector3d(4, 0, 6));
  EXPECT_EQ(ParsePins(text, "pins.points").at("s6"), few);
}

TEST(PinsFile, OtherLinesStayByteForByte) {
  const std::string text =
      "% our corners\r\n"
      "s4  1 2   3 4 5   2   % foot\r\n"
      "s5  9 9   9 9 9   2\n"
      "\n"
      "% off the record: s9 is blurred\n"
      "s7 1 2 3 4 5 6";
  const std::string replaced = ReplacePins(text, "s5", FourAndALine());
  EXPECT_THAT(replaced, HasSubstr("% our corners\r\ns4  1 2   3 4 5   2   % foot\r\ns5"));
  EXPECT_THAT(replaced, HasSubstr("\n\n% off the record: s9 is blurred\ns7 1 2 3 4 5 6\n"));
  EXPECT_EQ(replaced.find("9 9   9"), std::string::npos);
  EXPECT_EQ(ReplacePins(ReplacePins("", "s5", FourAndALine()), "s5", {}), "");
}

TEST(PinsFile, LinesThatEndAsOnOldMacintoshesStay) {
  const std::string text = "s4 1 2 3 4 5 2\rs5 9 9 9 9 9 2\rs6 1 2 3 4 5 2\r";
  const std::string replaced = ReplacePins(text, "s5", {});
  EXPECT_EQ(replaced.substr(0, 30), "s4 1 2 3 4 5 2\rs6 1 2 3 4 5 2\r");
}

TEST(PinsFile, ALineAtFaultIsNamed) {
  EXPECT_THAT(ThrownMessage([] { ParsePins("s5 1 2 3 4 5 6 7", "p.points"); }),
              HasSubstr("7 words"));
  EXPECT_THAT(ThrownMessage([] { ParsePins("\ns5 1 2 x 4 5 6", "p.points"); }),
              HasSubstr("p.points:2: 'x' is not a finite number"));
  EXPECT_THAT(ThrownMessage([] { ParsePins("s5 1 2 3 4 5 0", "p.points"); }),
              HasSubstr("must be above 0"));
  EXPECT_THAT(ThrownMessage([] { ParsePins("s5 1 2 3", "p.points"); }), HasSubstr("7 words"));
}

}  // namespace
}  // namespace groundglass
