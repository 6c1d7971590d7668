// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "report/report.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(ReportOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [title, picture, find, megabytes] = ReportOptions();
  ExpectCheckNamesEach<ReportOptions>({
      {"picture_width_px", [](auto& o) { o.picture_width_px = 0; }},
      {"max_megabytes", [](auto& o) { o.max_megabytes = 0; }},
  });
}

}  // namespace
}  // namespace groundglass
