// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/error_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(FormatErrorPlot, DrawsEachPointWhereItsNumbersAre) {
  // Decades from 0.1 to 100 over a panel 330 high and wide from 64, 54.
  const std::string svg = FormatErrorPlot(
      {{"s1", 10, 1, 0.2, 0.1, Verdict::kAccepted}, {"s<2>", 100, 0.1, 0.4, 0, Verdict::kReview}},
      "Errors of a & b",
      "ft");
  EXPECT_THAT(svg, testing::HasSubstr("cx=\"284.0\" cy=\"274.0\""));
  EXPECT_THAT(svg, testing::HasSubstr("cx=\"394.0\" cy=\"384.0\""));
  EXPECT_THAT(svg, testing::HasSubstr("<title>s&lt;2&gt;: 100, 0.1, review</title>"));
  EXPECT_THAT(svg, testing::HasSubstr("Errors of a &amp; b"));
  EXPECT_EQ(Count(svg, "<title>s1"), 2);      // in both panels
  EXPECT_EQ(Count(svg, "<title>s&lt;2"), 1);  // claims no sigma
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
}

TEST(FormatErrorPlot, HasAPictureForNothingToo) {
  EXPECT_THAT(FormatErrorPlot({}, "nothing", "m"), testing::HasSubstr("</svg>"));
}

}  // namespace
}  // namespace groundglass
