// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/what_failed.h"

#include "scene/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(WhatFailed, NobodyHasToKnowWhatTheLanguageCallsIt) {
  EXPECT_EQ(WhatFailed(Error("s1.jpg: no such image file")), "s1.jpg: no such image file");
  EXPECT_THAT(WhatFailed(std::bad_alloc()), testing::HasSubstr("not enough memory"));
}

}  // namespace
}  // namespace groundglass
