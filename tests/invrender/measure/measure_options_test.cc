// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_options.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(InvrenderOptions, PatchCheckNamesEachField) {
  [[maybe_unused]] const auto& [max_patches, max_views, max_coarseness, clear_px] = PatchOptions();
  ExpectCheckNamesEach<PatchOptions>({
      {"max_patches", [](auto& o) { o.max_patches = 0; }},
      {"max_views", [](auto& o) { o.max_views = 1; }},
      {"max_coarseness", [](auto& o) { o.max_coarseness = 0; }},
      {"clear_px", [](auto& o) { o.clear_px = -1; }},
  });
}

TEST(InvrenderOptions, BlockCheckNamesEachField) {
  [[maybe_unused]] const auto& [black, burnt, clear_px] = BlockOptions();
  ExpectCheckNamesEach<BlockOptions>({
      {"black", [](auto& o) { o.black = 0; }},
      {"burnt", [](auto& o) { o.burnt = 2; }},
      {"clear_px", [](auto& o) { o.clear_px = -1; }},
  });
}

TEST(InvrenderOptions, SharpnessCheckNamesEachField) {
  [[maybe_unused]] const auto& [alike,
                                ordinary_blur_px2,
                                ordinary_weight,
                                least_blur_px2,
                                doubtful,
                                certain,
                                detail_floor] = SharpnessOptions();
  ExpectCheckNamesEach<SharpnessOptions>({
      {"alike", [](auto& o) { o.alike = -1; }},
      {"ordinary_blur_px2", [](auto& o) { o.ordinary_blur_px2 = -1; }},
      {"ordinary_weight", [](auto& o) { o.ordinary_weight = -1; }},
      {"least_blur_px2", [](auto& o) { o.least_blur_px2 = -1; }},
      {"doubtful", [](auto& o) { o.doubtful = kNotANumber; }},
      {"certain", [](auto& o) { o.certain = 2; }},
      {"detail_floor", [](auto& o) { o.detail_floor = -1; }},
  });
}

}  // namespace
}  // namespace groundglass
