// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/check_option.h"
#include "scene/feature_edges.h"
#include "scene/formats/image_io.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(CheckOption, SaysTheFieldTheRuleAndTheValue) {
  EXPECT_EQ(ThrownMessage([] { CheckFromTo(5, 1, 4, "options: size"); }),
            "options: size must be from 1 to 4, not 5");
  EXPECT_EQ(ThrownMessage([] { CheckAtLeast(-0.5, 0, "options: size"); }),
            "options: size must be at least 0, not -0.5");
  EXPECT_EQ(ThrownMessage([] { CheckAbove(0, 0, "options: size"); }),
            "options: size must be above 0, not 0");
  EXPECT_EQ(ThrownMessage([] { CheckFinite(kInfinity, "options: size"); }),
            "options: size must be a finite number, not inf");
  try {
    CheckAbove(0, 0, "options: size");
    FAIL();
  } catch (const OptionError& error) {
    EXPECT_EQ(error.field(), "options: size");
    EXPECT_EQ(error.rule(), "must be above 0, not 0");
  }
  CheckFromTo(1, 1, 4, "");
  CheckFromTo(4, 1, 4, "");
  CheckAtLeast(0, 0, "");
}

TEST(CheckOption, IsNeverSatisfiedByNotANumber) {
  EXPECT_THROW(CheckFromTo(kNotANumber, 1, 4, ""), Error);
  EXPECT_THROW(CheckAtLeast(kNotANumber, 0, ""), Error);
  EXPECT_THROW(CheckAbove(kNotANumber, 0, ""), Error);
  EXPECT_THROW(CheckFinite(kNotANumber, ""), Error);
  EXPECT_THROW(CheckAtLeast(kInfinity, 0, ""), Error);
  EXPECT_THROW(CheckAbove(kInfinity, 0, ""), Error);
}

TEST(SceneOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [crease, borders] = FeatureEdgeOptions();
  ExpectCheckNamesEach<FeatureEdgeOptions>({
      {"min_crease_deg", [](auto& o) { o.min_crease_deg = kNotANumber; }},
  });
  [[maybe_unused]] const auto& [quality, bits] = ImageWriteOptions();
  ExpectCheckNamesEach<ImageWriteOptions>({
      {"jpeg_quality", [](auto& o) { o.jpeg_quality = 0; }},
      {"bits", [](auto& o) { o.bits = 12; }},
  });
}

}  // namespace
}  // namespace groundglass
