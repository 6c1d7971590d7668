// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/recipe.h"
#include "datasets-synthetic/surface_truth.h"
#include "evaluate/trials.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(SynthOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [trials,
                                seed,
                                position,
                                height,
                                lookat,
                                overclaim,
                                blunders,
                                registration] = TrialOptions();
  ExpectCheckNamesEach<TrialOptions>({
      {"num_trials", [](auto& o) { o.num_trials = 0; }},
      {"sigma_position", [](auto& o) { o.sigma_position = kNotANumber; }},
      {"sigma_height", [](auto& o) { o.sigma_height = 0; }},
      {"sigma_lookat", [](auto& o) { o.sigma_lookat = kInfinity; }},
      {"overclaim", [](auto& o) { o.overclaim = 0; }},
      {"num_blunders", [](auto& o) { o.num_blunders = -1; }},
      {"registration options: max_width_px", [](auto& o) { o.registration.max_width_px = 0; }},
  });
  [[maybe_unused]] const auto& [texel, width, tall] = SurfaceTruthOptions();
  ExpectCheckNamesEach<SurfaceTruthOptions>({
      {"texel", [](auto& o) { o.texel = 0; }},
      {"page_width_px", [](auto& o) { o.page_width_px = 0; }},
      {"page_height_px", [](auto& o) { o.page_height_px = -1; }},
  });
  ExpectCheckNamesEach<SynthRecipe>({
      {"lens/k1", [](auto& o) { o.lens.k1 = kNotANumber; }},
      {"photo/grain", [](auto& o) { o.photo.grain = kInfinity; }},
      {"april_tags/count", [](auto& o) { o.april_tags.count = -1; }},
      {"april_tags/size", [](auto& o) { o.april_tags.size = 0; }},
      {"april_tags/sigma", [](auto& o) { o.april_tags.sigma = 0; }},
      {"slide/sigma_shift", [](auto& o) { o.slide.sigma_shift = kNotANumber; }},
  });
}

}  // namespace
}  // namespace groundglass
