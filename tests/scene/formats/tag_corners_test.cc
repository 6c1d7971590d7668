// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/tag_corners.h"

#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::HasSubstr;

class TagCornersTest : public TemporaryFolder, public testing::Test {
 protected:
  std::string Message(const std::string& text) {
    const auto file = Write("c.csv", text);
    return ThrownMessage([&] { ReadTagCorners(file); });
  }
};

TEST_F(TagCornersTest, ComeBackAsTheyWereWritten) {
  const std::vector<SeenTagCorner> corners = {
      {"s5", 7, 0, {412.5, 63.25}, 0.1, {10, -20.5, 3.25}, 0.05},
      {"with, comma", 8, 3, {1, 2}, 0.5, {0, 0, 0}, 0.01}};
  const auto read = ReadTagCorners(Write("c.csv", FormatTagCorners(corners)));
  ASSERT_EQ(read.size(), 2U);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].photograph, corners[i].photograph);
    EXPECT_EQ(read[i].april_tag, corners[i].april_tag);
    EXPECT_EQ(read[i].corner, corners[i].corner);
    EXPECT_EQ(read[i].image_px, corners[i].image_px);
    EXPECT_EQ(read[i].sigma_px, corners[i].sigma_px);
    EXPECT_EQ(read[i].surveyed_in_world, corners[i].surveyed_in_world);
    EXPECT_EQ(read[i].survey_sigma, corners[i].survey_sigma);
  }
  EXPECT_EQ(CountTagCorners(corners), "2 corners of 2 AprilTags");
  EXPECT_TRUE(ReadTagCorners(Write("none.csv", FormatTagCorners({}))).empty());
}

TEST_F(TagCornersTest, FaultsAreNamedWithTheirLine) {
  const std::string header = "photograph,id,corner,x_px,y_px,sigma_px,x,y,z,sigma\n";
  EXPECT_THAT(Message("photograph,id\ns1,2\n"), HasSubstr("c.csv:1: expected the columns"));
  EXPECT_THAT(Message(header + "s1,2,5,1,1,1,0,0,0,1\n"), HasSubstr("c.csv:2: id must be"));
  EXPECT_THAT(Message(header + "s1,2,1,x,1,1,0,0,0,1\n"),
              HasSubstr("c.csv:2: x_px: 'x' is not a number"));
  EXPECT_THAT(Message(header + "s1,2,1,1,1,0,0,0,0,1\n"), HasSubstr("must be above 0"));
}

}  // namespace
}  // namespace groundglass
