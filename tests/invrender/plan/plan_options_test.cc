// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_options.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(InvrenderOptions, MemoryCheckNamesEachField) {
  [[maybe_unused]] const auto& [max_memory_mb,
                                photo_share,
                                few_photos,
                                max_texel_scale,
                                max_halvings,
                                worth_dropping,
                                worth_halving,
                                mask_estimate_factor] = MemoryOptions();
  ExpectCheckNamesEach<MemoryOptions>({
      {"max_memory_mb", [](auto& o) { o.max_memory_mb = -1; }},
      {"photo_share", [](auto& o) { o.photo_share = 2; }},
      {"few_photos", [](auto& o) { o.few_photos = 0; }},
      {"max_texel_scale", [](auto& o) { o.max_texel_scale = 0; }},
      {"max_halvings", [](auto& o) { o.max_halvings = -1; }},
      {"worth_dropping", [](auto& o) { o.worth_dropping = 0; }},
      {"worth_halving", [](auto& o) { o.worth_halving = 0; }},
      {"mask_estimate_factor", [](auto& o) { o.mask_estimate_factor = 0; }},
  });
}

TEST(InvrenderOptions, ViewpointCheckNamesEachField) {
  [[maybe_unused]] const auto& [eye_level_ft, turns_deg, distances, least_cosine, most_backs] =
      ViewpointOptions();
  ExpectCheckNamesEach<ViewpointOptions>({
      {"eye_level_ft", [](auto& o) { o.eye_level_ft = 0; }},
      {"turns_deg", [](auto& o) { o.turns_deg[6] = 100; }},
      {"distances", [](auto& o) { o.distances[2] = 0; }},
      {"least_cosine", [](auto& o) { o.least_cosine = 2; }},
      {"most_backs", [](auto& o) { o.most_backs = -1; }},
  });
}

TEST(InvrenderOptions, CoverageCheckNamesEachField) {
  [[maybe_unused]] const auto& [least_missing_share, viewpoint] = CoverageOptions();
  ExpectCheckNamesEach<CoverageOptions>({
      {"least_missing_share", [](auto& o) { o.least_missing_share = -1; }},
      {"viewpoint.least_cosine", [](auto& o) { o.viewpoint.least_cosine = -1; }},
  });
}

}  // namespace
}  // namespace groundglass
