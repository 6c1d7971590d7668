// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/bake.h"
#include "invrender/tiles1988/tiles.h"
#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

TEST(InvrenderOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [texel,
                                page,
                                gutter,
                                border,
                                frame,
                                memory,
                                mount,
                                colour,
                                occluders,
                                sharpness,
                                grain,
                                seams,
                                gaps,
                                bits,
                                earlier,
                                on_mask] = BakeOptions();
  ExpectCheckNamesEach<BakeOptions>({
      {"texel_size", [](auto& o) { o.texel_size = kNotANumber; }},
      {"max_page_texels", [](auto& o) { o.max_page_texels = 63; }},
      {"gutter_texels", [](auto& o) { o.gutter_texels = 0; }},
      {"border_margin_px", [](auto& o) { o.border_margin_px = kInfinity; }},
      {"frame_margin", [](auto& o) { o.frame_margin = 0.5; }},
      {"max_memory_mb", [](auto& o) { o.max_memory_mb = -1; }},
      {"bits", [](auto& o) { o.bits = 10; }},
  });
  [[maybe_unused]] const auto& [downsample] = TileOptions();
  ExpectCheckNamesEach<TileOptions>({
      {"downsample", [](auto& o) { o.downsample = 2; }},
  });
}

}  // namespace
}  // namespace groundglass
