// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/view_template.h"

#include "scene/formats/view_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string Filled(std::string text) {
  for (size_t at; (at = text.find(" ?")) != std::string::npos;) text.replace(at, 2, " 7.5");
  const size_t i = text.find("\ni 7.5");
  return text.replace(i, 6, "\ni 9.5");
}

TEST(ViewTemplate, IsNoTagUntilItIsFilledIn) {
  const std::string text = FormatViewTemplate("s5.jpg", {1200, 800}, LengthUnit::kMetre, {});
  EXPECT_THAT(FindViewFaults(text, "s5.view"),
              ElementsAre("s5.view:7: this template is not filled in yet: write a number in place "
                          "of the ? of x, y, z, i, j, k, v"));
  EXPECT_THAT(text, HasSubstr("(m)"));
  const ViewTag tag = ParseView(Filled(text), "s5.view");
  EXPECT_EQ(tag.aspect, 1.5);
  EXPECT_EQ(tag.position_in_site, Eigen::Vector3d(7.5, 7.5, 7.5));
}

TEST(ViewTemplate, KnowsTheAngleOfALens) {
  EXPECT_NEAR(ViewAngleDegFromFocalLength(35, 1.5), 54.432, 1e-3);      // 2 atan(18 / 35)
  EXPECT_NEAR(ViewAngleDegFromFocalLength(35, 1 / 1.5), 37.849, 1e-3);  // 2 atan(12 / 35)
  const std::string text =
      FormatViewTemplate("a.jpg", {800, 1200}, LengthUnit::kFoot, 37.849, "26 mm for 35 mm film");
  EXPECT_THAT(text, HasSubstr("\nv 37.85 "));
  EXPECT_THAT(text, HasSubstr("f in mm; here from 26 mm for 35 mm film\n"));
}

}  // namespace
}  // namespace groundglass
