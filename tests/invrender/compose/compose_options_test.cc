// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_options.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(InvrenderOptions, GrainCheckNamesEachField) {
  [[maybe_unused]] const auto& [grain_agreement,
                                detail_agreement,
                                calm_one_in,
                                few_patches,
                                fewest_patches,
                                calm_quantile,
                                prior_patches,
                                dark,
                                vignetting_at] = GrainOptions();
  ExpectCheckNamesEach<GrainOptions>({
      {"grain_agreement", [](auto& o) { o.grain_agreement = -2; }},
      {"detail_agreement", [](auto& o) { o.detail_agreement = 0.1; }},
      {"calm_one_in", [](auto& o) { o.calm_one_in = -1; }},
      {"few_patches", [](auto& o) { o.few_patches = -1; }},
      {"fewest_patches", [](auto& o) { o.fewest_patches = -1; }},
      {"calm_quantile", [](auto& o) { o.calm_quantile = -1; }},
      {"prior_patches", [](auto& o) { o.prior_patches = -1; }},
      {"dark", [](auto& o) { o.dark = -1; }},
      {"vignetting_at", [](auto& o) { o.vignetting_at = -1; }},
  });
}

TEST(InvrenderOptions, BlendCheckNamesEachField) {
  [[maybe_unused]] const auto& [across_seams,
                                clear_px,
                                ramp_start_px,
                                ramp_px,
                                least_border_weight,
                                enough_chosen,
                                others_weight,
                                least_consistency,
                                negligible,
                                good_weight,
                                reach_beyond_px,
                                farthest_reach,
                                sampling] = BlendOptions();
  ExpectCheckNamesEach<BlendOptions>({
      {"clear_px", [](auto& o) { o.clear_px = -1; }},
      {"ramp_start_px", [](auto& o) { o.ramp_start_px = kInfinity; }},
      {"ramp_px", [](auto& o) { o.ramp_px = -1; }},
      {"least_border_weight", [](auto& o) { o.least_border_weight = -1; }},
      {"enough_chosen", [](auto& o) { o.enough_chosen = -1; }},
      {"others_weight", [](auto& o) { o.others_weight = -1; }},
      {"least_consistency", [](auto& o) { o.least_consistency = -1; }},
      {"negligible", [](auto& o) { o.negligible = -1; }},
      {"good_weight", [](auto& o) { o.good_weight = -1; }},
      {"reach_beyond_px", [](auto& o) { o.reach_beyond_px = -1; }},
      {"farthest_reach", [](auto& o) { o.farthest_reach = -1; }},
      {"sampling.one_tap_px", [](auto& o) { o.sampling.one_tap_px = 3; }},
  });
}

TEST(InvrenderOptions, DilateCheckNamesEachField) {
  [[maybe_unused]] const auto& [slit_texels] = DilateOptions();
  ExpectCheckNamesEach<DilateOptions>({
      {"slit_texels", [](auto& o) { o.slit_texels = -1; }},
  });
}

TEST(InvrenderOptions, FillCheckNamesEachField) {
  [[maybe_unused]] const auto& [radius_texels] = FillOptions();
  ExpectCheckNamesEach<FillOptions>({
      {"radius_texels", [](auto& o) { o.radius_texels = -1; }},
  });
}

}  // namespace
}  // namespace groundglass
