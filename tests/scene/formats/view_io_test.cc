// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/view_io.h"

#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <random>

namespace groundglass {
namespace {

using testing::HasSubstr;

constexpr const char* kThesisFile =
    "% File: s5.view\n"
    "% Purpose: The View from slide position 5\n"
    "\n"
    "x 232      % camera x in feet.\n"
    "y -104     % camera y in feet.\n"
    "z 4.5\n"
    "\n"
    "% The corner of the roof\n"
    "i 104 j -2 k 33.1   % the point looked at\n"
    "a 1.5\n"
    "v 58";

ViewTag ThesisTag() { return ParseView(kThesisFile, "s5.view"); }

TEST(ParseView, ReadsTheThesisFile) {
  const ViewTag tag = ThesisTag();
  EXPECT_EQ(tag.position_in_site, Eigen::Vector3d(232, -104, 4.5));
  EXPECT_EQ(tag.lookat_in_site, Eigen::Vector3d(104, -2, 33.1));
  EXPECT_EQ(tag.aspect, 1.5);
  EXPECT_EQ(tag.view_angle_deg, 58);
  EXPECT_EQ(tag.roll_deg, 0);
  EXPECT_FALSE(tag.sigmas.position);
}

TEST(ParseView, TakesAnyOrderLineEndsAndExtensions) {
  const ViewTag tag = ParseView(
      "\xEF\xBB\xBFv 58\r\na 1.5\r\ni 1 j 2 k 3\rx +4 y 5e0\nz\n\n  6% stuck comment\n"
      "roll -0.5 shift_x .01 shift_y -1e-3 k1 -0.02 k2 0.003 sigma_position 0.2 sigma_height .1\n"
      "sigma_lookat 1 sigma_roll 2 sigma_v 3 sigma_a 4 sigma_shift 5 sigma_k1 6 camera nikon-f2",
      "any.view");
  EXPECT_EQ(tag.position_in_site, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(tag.lookat_in_site, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(tag.roll_deg, -0.5);
  EXPECT_EQ(tag.shift_x, 0.01);
  EXPECT_EQ(tag.shift_y, -0.001);
  EXPECT_EQ(tag.k1, -0.02);
  EXPECT_EQ(tag.k2, 0.003);
  EXPECT_EQ(tag.sigmas.position, 0.2);
  EXPECT_EQ(tag.sigmas.k1, 6);
  EXPECT_EQ(tag.camera, "nikon-f2");
}

struct BadView {
  const char* change;    // appended to the thesis file, or all of it if it starts with '='
  const char* expected;  // the whole message
};

class BadViewTest : public testing::TestWithParam<BadView> {};

TEST_P(BadViewTest, GivesItsOneLine) {
  std::string text = GetParam().change;
  text = text.front() == '=' ? text.substr(1) : kThesisFile + ("\n" + text);
  EXPECT_EQ(ThrownMessage([&] { ParseView(text, "views/s5.view"); }), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Faults,
    BadViewTest,
    testing::Values(
        BadView{"pan 3",
                "views/s5.view:12: unknown key 'pan'; the keys are x y z i j k a v roll shift_x "
                "shift_y k1 k2 k3 p1 p2 sigma_... camera"},
        BadView{"x 3", "views/s5.view:12: key 'x' is repeated; it stands on line 4 already"},
        BadView{"=x 1 y 2 z 3 i 4 j 5 k 6 a 1.5", "views/s5.view: key 'v' is missing"},
        BadView{"=",
                "views/s5.view: this view file is empty; expected x, y, z, i, j, k, a and v, each "
                "with its value"},
        BadView{"roll 2,5",
                "views/s5.view:12: key 'roll': '2,5' is not a number; write 2.5, with a point"},
        BadView{"roll \u22122.5",
                "views/s5.view:12: key 'roll': '\u22122.5' is not a number, for its minus is a "
                "dash; write -2.5"},
        BadView{"roll 2.5deg",
                "views/s5.view:12: key 'roll': '2.5deg' is not a number; write 2.5 alone, without "
                "'deg'"},
        BadView{"ROLL 2",
                "views/s5.view:12: unknown key 'ROLL'; write 'roll', a blank and its value"},
        BadView{"roll: 2",
                "views/s5.view:12: unknown key 'roll:'; write 'roll', a blank and its value"},
        BadView{"roll=2",
                "views/s5.view:12: unknown key 'roll=2'; write 'roll', a blank and its value"},
        BadView{"# from the 2nd x", "views/s5.view:12: unknown key '#'; a comment begins with %"},
        BadView{"roll 5O",
                "views/s5.view:12: key 'roll': '5O' is not a number; is it 50, with a letter in "
                "place of a digit?"},
        BadView{"roll 3:2", "views/s5.view:12: key 'roll': '3:2' is not a number; write 1.5"},
        BadView{"roll 2\u00B0",
                "views/s5.view:12: key 'roll': '2\u00B0' is not a number; write 2 alone, without "
                "'\u00B0'"},
        BadView{"roll = 2", "views/s5.view:12: key 'roll': '=' is not needed; write roll 2"},
        BadView{"roll 1e38", "views/s5.view:12: key 'roll': expected degrees, from -360 to 360"},
        BadView{"k1 1e38",
                "views/s5.view:12: key 'k1': no lens has a distortion of 1e+38; leave it out if it "
                "is not known"},
        BadView{
            "shift_x 1e38",
            "views/s5.view:12: key 'shift_x': expected a share of the frame's width, 0.02 for a "
            "fiftieth"},
        BadView{"sigma_position 1e38",
                "views/s5.view:12: key 'sigma_position': a standard deviation of 1e+38 says "
                "nothing; expected 10000000 or less, or leave it out"},
        BadView{"sigma_roll 1e38",
                "views/s5.view:12: key 'sigma_roll': a standard deviation of 1e+38 says nothing; "
                "expected 360 or less, or leave it out"},
        BadView{"=x 1e15 y 2 z 3\ni 4 j 5 k 6 a 1.5\nv 50",
                "views/s5.view:1: key 'x': no place on earth has a coordinate of 1e+15; is there a "
                "digit too many?"},
        BadView{"roll two", "views/s5.view:12: key 'roll': 'two' is not a number"},
        BadView{"roll 0x10", "views/s5.view:12: key 'roll': '0x10' is not a number"},
        BadView{"roll nan", "views/s5.view:12: key 'roll': 'nan' is not a finite number"},
        BadView{"k1 1e999", "views/s5.view:12: key 'k1': '1e999' is not a finite number"},
        BadView{"roll", "views/s5.view:12: key 'roll' has no value"},
        BadView{"roll k1 3", "views/s5.view:12: key 'roll' has no value"},
        BadView{"sigma_v 0",
                "views/s5.view:12: key 'sigma_v': a standard deviation must be above 0"},
        BadView{"=x 1 y 2 z 3\ni 4 j 5 k 6 a 1.5\nv 180",
                "views/s5.view:3: key 'v': view angle must lie between 0 and 180 degrees; of a "
                "lens of f mm before 35 mm film it is 2 atan(18 / f)"},
        BadView{"=x 1 y 2 z 3\ni 4 j 5 k 6 a 1.5\nv 0",
                "views/s5.view:3: key 'v': view angle must lie between 0 and 180 degrees; of a "
                "lens of f mm before 35 mm film it is 2 atan(18 / f)"},
        BadView{"=x 1 y 2 z 3\ni 4 j 5 k 6 a -1.5\nv 50",
                "views/s5.view:2: key 'a': aspect (width / height) must be above 0"},
        BadView{"=x 1 y 2 z 3\ni 1 j 2 k 3 a 1.5\nv 50",
                "views/s5.view:2: key 'i': look-at point is the camera's own position, so it "
                "gives no direction"},
        BadView{"=x 1 y 2 z 3\ni 1 j 2 k 9 a 1.5\nv 50",
                "views/s5.view:2: key 'k': view is straight up or down, where yaw has no "
                "meaning"}));

TEST(FindViewFaults, TellsAllOfThemAtOnce) {
  const std::vector<std::string> faults =
      FindViewFaults("x one\nx 2\npan 3\ny 1 z 1 i 2 j 2 k 2 a 1", "s.view");
  ASSERT_EQ(faults.size(), 4u);
  EXPECT_THAT(faults[0], HasSubstr("s.view:1: key 'x': 'one' is not a number"));
  EXPECT_THAT(faults[1], HasSubstr("s.view:2: key 'x' is repeated"));
  EXPECT_THAT(faults[2], HasSubstr("s.view:3: unknown key 'pan'"));
  EXPECT_THAT(faults[3], HasSubstr("s.view: key 'v' is missing"));
}

TEST(FindViewFaults, ABlankAfterTheSignIsOneFault) {
  const std::vector<std::string> faults =
      FindViewFaults("x 1\ny - 74.9\nz 5 i 1 j 2 k 3 a 1.5 v 54", "s.view");
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0],
            "s.view:2: key 'y': a blank stands between the sign and the number; write -74.9");
}

TEST(ReadView, ReadsWhatNotepadSavesAsUnicode) {
  const TemporaryFolder folder;
  std::string utf16 = "\xFF\xFE";
  for (const char* c = kThesisFile; *c != 0; ++c) utf16 += {*c, '\0'};
  EXPECT_EQ(FormatView(ReadView(folder.Write("s5.view", utf16))),
            FormatView(ParseView(kThesisFile, "s5.view")));
}

TEST(ReadView, ARichTextDocumentIsNamed) {
  const TemporaryFolder folder;
  const auto file = folder.Write("s1.view", "{\\rtf1\\ansi\n x 1\\par\n}");
  EXPECT_THAT(ThrownMessage([&] { ReadView(file); }),
              testing::HasSubstr("rich-text document (RTF); save it as plain text"));
}

TEST(ReadView, NamesAMissingFile) {
  EXPECT_EQ(ThrownMessage([] { ReadView("no/such.view"); }), "no/such.view: cannot open this file");
}

TEST(ReadView, RefusesAPictureInOneShortLine) {
  const std::string message =
      ThrownMessage([] { ParseView(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16), "s.view"); });
  EXPECT_THAT(message, HasSubstr("s.view:1: unknown key"));
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_EQ(message.find('\r'), std::string::npos);
}

TEST(ParseView, DoesNotHeedTheLocale) {
  const std::string before = setlocale(LC_ALL, nullptr);
  if (setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no German locale here";
  EXPECT_EQ(ThesisTag().lookat_in_site.z(), 33.1);
  EXPECT_THAT(FormatView(ThesisTag()), HasSubstr("k 33.1\n"));
  setlocale(LC_ALL, before.c_str());
}

ViewTag RandomTag(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  ViewTag tag;
  for (int key = 0; key < kNumTagKeys; ++key) {
    SetTagValue(tag, static_cast<TagKey>(key), unit(random) * std::pow(10, 2 * unit(random)));
  }
  tag.aspect = std::abs(tag.aspect);
  tag.view_angle_deg = 1 + std::abs(unit(random)) * 178;
  return tag;
}

TEST(FormatView, ReadsBackToTheLastBit) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 500; ++trial) {
    ViewTag tag = RandomTag(random);
    tag.sigmas.position = 0.1 * trial + 1e-3;
    tag.camera = "leica";
    EXPECT_EQ(ParseView(FormatView(tag, "one\ntwo"), "t.view"), tag);
  }
}

TEST(FormatView, LeavesDefaultsOut) {
  EXPECT_EQ(FormatView(ThesisTag(), "File: s5.view"),
            "% File: s5.view\nx 232\ny -104\nz 4.5\ni 104\nj -2\nk 33.1\na 1.5\nv 58\n");
}

TEST(FormatCorrectedView, ReplacesNumbersInPlaceAndNotesWhatWasMeasured) {
  ViewTag corrected = ThesisTag();
  corrected.position_in_site.x() = 231.4187301;
  corrected.lookat_in_site = {104.25, -2, 33};
  corrected.roll_deg = 0.3;
  TagDeviations deviations{};
  deviations[static_cast<int>(TagKey::kX)] = 0.0312;
  deviations[static_cast<int>(TagKey::kI)] = 0.5;
  deviations[static_cast<int>(TagKey::kRoll)] = 12.3;
  const std::string text = FormatCorrectedView(kThesisFile, corrected, deviations);
  EXPECT_EQ(text,
            "% File: s5.view\n"
            "% Purpose: The View from slide position 5\n"
            "\n"
            "x 231.4187301      % camera x in feet. (measured 232, now +-0.031)\n"
            "y -104     % camera y in feet.\n"
            "z 4.5\n"
            "\n"
            "% The corner of the roof\n"
            "i 104.25 j -2 k 33   % the point looked at (i measured 104, now +-0.5) (k measured "
            "33.1)\n"
            "a 1.5\n"
            "v 58\n"
            "roll 0.3 % (not measured, now +-12)\n");
  EXPECT_EQ(ParseView(text, "again"), corrected);
}

TEST(FormatCorrectedView, KeepsTheFirstMeasuredValueWhenCorrectedAgain) {
  ViewTag first = ThesisTag();
  first.position_in_site.x() = 231;
  first.lookat_in_site = {103, -3, 34};
  first.roll_deg = 1;
  TagDeviations deviations;
  deviations.fill(0.25);
  const std::string once = FormatCorrectedView(kThesisFile, first, deviations);
  EXPECT_EQ(FormatCorrectedView(once, first, deviations), once);

  ViewTag second = first;
  second.position_in_site.x() = 230.5;
  second.lookat_in_site = {103.5, -3.5, 34.5};
  second.roll_deg = 2;
  deviations.fill(0.125);
  const std::string twice = FormatCorrectedView(once, second, deviations);
  EXPECT_EQ(ParseView(twice, "twice"), second);
  EXPECT_EQ(twice, FormatCorrectedView(kThesisFile, second, deviations));
  EXPECT_THAT(twice, HasSubstr("x 230.5      % camera x in feet. (measured 232, now +-0.13)\n"));
  EXPECT_THAT(twice, HasSubstr("roll 2 % (not measured, now +-0.13)\n"));
}

TEST(FormatCorrectedView, ChangesNothingForTheMeasuredTag) {
  EXPECT_EQ(FormatCorrectedView(kThesisFile, ThesisTag(), TagDeviations{}), kThesisFile);
}

TEST(FormatCorrectedView, IsNotFooledByAHandWrittenComment) {
  ViewTag corrected = ParseView("x 1 % (measured with tape)\ny 2 z 3 i 4 j 5 k 6 a 1 v 50\n", "t");
  corrected.position_in_site.x() = 1.5;
  EXPECT_THAT(
      FormatCorrectedView(
          "x 1 % (measured with tape)\ny 2 z 3 i 4 j 5 k 6 a 1 v 50\n", corrected, TagDeviations{}),
      HasSubstr("x 1.5 % (measured with tape) (measured 1)\n"));
}

TEST(FormatCorrectedView, KeepsDosLineEnds) {
  const std::string measured = "x 1\r\ny 2\r\nz 3\r\ni 4 j 5 k 6\r\na 1\r\nv 50 % wide \r\n";
  ViewTag corrected = ParseView(measured, "t");
  corrected.view_angle_deg = 51;
  corrected.k1 = -0.5;
  EXPECT_EQ(FormatCorrectedView(measured, corrected, TagDeviations{}),
            "x 1\r\ny 2\r\nz 3\r\ni 4 j 5 k 6\r\na 1\r\nv 51 % wide (measured 50) \r\n"
            "k1 -0.5 % (not measured)\r\n");
}

TEST(FormatCorrectedView, ReadsBackToTheLastBit) {
  std::mt19937_64 random(12);
  for (int trial = 0; trial < 300; ++trial) {
    const ViewTag measured = RandomTag(random);
    const ViewTag corrected = RandomTag(random);
    const std::string text = FormatCorrectedView(FormatView(measured), corrected, {});
    EXPECT_EQ(ParseView(text, "t.view"), corrected);
  }
}

}  // namespace
}  // namespace groundglass
