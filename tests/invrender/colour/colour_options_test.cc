// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_options.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(InvrenderOptions, ColourCheckNamesEachField) {
  [[maybe_unused]] const auto& [even_light,
                                fewest_shared,
                                enough_for_pairs,
                                enough_of_pair,
                                most_shared,
                                vignetting_scale,
                                vignetting_rounds,
                                vignetting_prior,
                                many_blocks,
                                gain_scales,
                                gain_prior,
                                light_rounds,
                                few_blocks,
                                enough_for_light,
                                most_uneven] = ColourOptions();
  ExpectCheckNamesEach<ColourOptions>({
      {"even_light", [](auto& o) { o.even_light = -1; }},
      {"fewest_shared", [](auto& o) { o.fewest_shared = -1; }},
      {"enough_for_pairs", [](auto& o) { o.enough_for_pairs = -1; }},
      {"enough_of_pair", [](auto& o) { o.enough_of_pair = -1; }},
      {"most_shared", [](auto& o) { o.most_shared = -1; }},
      {"vignetting_scale", [](auto& o) { o.vignetting_scale = -1; }},
      {"vignetting_rounds", [](auto& o) { o.vignetting_rounds = -1; }},
      {"vignetting_prior", [](auto& o) { o.vignetting_prior = -1; }},
      {"many_blocks", [](auto& o) { o.many_blocks = -1; }},
      {"gain_scales", [](auto& o) { o.gain_scales[10] = 0; }},
      {"gain_prior", [](auto& o) { o.gain_prior = -1; }},
      {"light_rounds", [](auto& o) { o.light_rounds = -1; }},
      {"few_blocks", [](auto& o) { o.few_blocks = -1; }},
      {"enough_for_light", [](auto& o) { o.enough_for_light = -1; }},
      {"most_uneven", [](auto& o) { o.most_uneven = -1; }},
  });
}

}  // namespace
}  // namespace groundglass
