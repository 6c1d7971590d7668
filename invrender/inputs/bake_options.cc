// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/inputs/bake_options.h"

#include "scene/check_option.h"
#include "scene/error.h"

namespace groundglass {

void BakeOptions::Check() const {
  CheckAtLeast(texel_size, 0, "texel_size");
  CheckFromTo(max_page_texels, 64, 32768, "max_page_texels");
  CheckFromTo(gutter_texels, 1, 24, "gutter_texels");
  CheckFromTo(border_margin_px, 0, 20, "border_margin_px");
  CheckFromTo(frame_margin, 0, 0.4, "frame_margin");
  CheckAtLeast(max_memory_mb, 0, "max_memory_mb");
  if (bits != 8 && bits != 16) throw Error("bits must be 8 or 16");
}

}  // namespace groundglass
