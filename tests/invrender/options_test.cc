// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake_options.h"
#include "invrender/tiles1988/tiles.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(InvrenderOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [charts,
                                photos,
                                pages,
                                memory,
                                blocks,
                                patches,
                                sharpness,
                                grain,
                                colour,
                                consistency,
                                seams,
                                blend,
                                dilate,
                                fill,
                                coverage,
                                stages,
                                match_colour,
                                reject_occluders,
                                fill_gaps,
                                as_photographed,
                                earlier_model,
                                on_face_mask] = BakeOptions();
  ExpectCheckNamesEach<BakeOptions>({
      {"charts.level_sine", [](auto& o) { o.charts.level_sine = 0; }},
      {"photos.frame_margin", [](auto& o) { o.photos.frame_margin = 0.5; }},
      {"photos.mount.dark_code", [](auto& o) { o.photos.mount.dark_code = -1; }},
      {"pages.bits", [](auto& o) { o.pages.bits = 10; }},
      {"memory.max_memory_mb", [](auto& o) { o.memory.max_memory_mb = -1; }},
      {"blocks.black", [](auto& o) { o.blocks.black = 0; }},
      {"patches.max_views", [](auto& o) { o.patches.max_views = 1; }},
      {"sharpness.alike", [](auto& o) { o.sharpness.alike = 2; }},
      {"grain.dark", [](auto& o) { o.grain.dark = 0; }},
      {"colour.even_light", [](auto& o) { o.colour.even_light = 0; }},
      {"consistency.agreeing", [](auto& o) { o.consistency.agreeing = 0; }},
      {"consistency.histogram.bins_per_unit",
       [](auto& o) { o.consistency.histogram.bins_per_unit = 0; }},
      {"seams.max_data_cost", [](auto& o) { o.seams.max_data_cost = 0; }},
      {"blend.ramp_px", [](auto& o) { o.blend.ramp_px = 0; }},
      {"blend.sampling.max_taps", [](auto& o) { o.blend.sampling.max_taps = 0; }},
      {"dilate.slit_texels", [](auto& o) { o.dilate.slit_texels = 0; }},
      {"fill.radius_texels", [](auto& o) { o.fill.radius_texels = 0; }},
      {"coverage.viewpoint.eye_level_ft", [](auto& o) { o.coverage.viewpoint.eye_level_ft = 0; }},
      {"earlier_model.same_normal_cosine", [](auto& o) { o.earlier_model.same_normal_cosine = 2; }},
      {"stages.smooth_seams", [](auto& o) { o.stages.smooth_seams = nullptr; }},
  });
  [[maybe_unused]] const auto& [downsample] = TileOptions();
  ExpectCheckNamesEach<TileOptions>({
      {"downsample", [](auto& o) { o.downsample = 2; }},
  });
}

TEST(InvrenderOptions, StagesCheckNamesEachField) {
  [[maybe_unused]] const auto& [estimate_colour,
                                measure_sharpness,
                                measure_consistency,
                                choose_blocks,
                                smooth_seams,
                                smooth_grain,
                                fill_gaps] = BakeStages();
  ExpectCheckNamesEach<BakeStages>({
      {"estimate_colour", [](auto& o) { o.estimate_colour = nullptr; }},
      {"measure_sharpness", [](auto& o) { o.measure_sharpness = nullptr; }},
      {"measure_consistency", [](auto& o) { o.measure_consistency = nullptr; }},
      {"choose_blocks", [](auto& o) { o.choose_blocks = nullptr; }},
      {"smooth_seams", [](auto& o) { o.smooth_seams = nullptr; }},
      {"smooth_grain", [](auto& o) { o.smooth_grain = nullptr; }},
      {"fill_gaps", [](auto& o) { o.fill_gaps = nullptr; }},
  });
}

}  // namespace
}  // namespace groundglass
