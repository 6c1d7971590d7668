// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_options.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(InvrenderOptions, ChartCheckNamesEachField) {
  [[maybe_unused]] const auto& [coplanar_sine, coplanar_share, level_sine] = ChartOptions();
  ExpectCheckNamesEach<ChartOptions>({
      {"coplanar_sine", [](auto& o) { o.coplanar_sine = -1; }},
      {"coplanar_share", [](auto& o) { o.coplanar_share = -1; }},
      {"level_sine", [](auto& o) { o.level_sine = -1; }},
  });
}

TEST(InvrenderOptions, PageCheckNamesEachField) {
  [[maybe_unused]] const auto& [texel_size,
                                kept_share,
                                texel_px,
                                needless_texels,
                                max_page_texels,
                                gutter_texels,
                                bits] = PageOptions();
  ExpectCheckNamesEach<PageOptions>({
      {"texel_size", [](auto& o) { o.texel_size = kNotANumber; }},
      {"kept_share", [](auto& o) { o.kept_share = 2; }},
      {"texel_px", [](auto& o) { o.texel_px = 0; }},
      {"needless_texels", [](auto& o) { o.needless_texels = 0; }},
      {"max_page_texels", [](auto& o) { o.max_page_texels = 63; }},
      {"gutter_texels", [](auto& o) { o.gutter_texels = 0; }},
      {"bits", [](auto& o) { o.bits = 10; }},
  });
}

}  // namespace
}  // namespace groundglass
