// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// The pages and how fine their texels are (ChooseTexelSizes, PackCharts).
struct PageOptions {
  // Side of a texel, model's unit; 0: the best photograph's footprint, face by face.
  double texel_size = 0;
  // With texel_size 0: the share of a chart whose best photograph the texels do not blur, and a
  // texel's side in pixels of that photograph. Texels as large as pixels, looked up between pixels
  // and shown between texels, would lose a third of the detail on the way.
  double kept_share = 0.75;
  double texel_px = 0.85;
  // With a texel_size: as many times the texels that the photographs resolve are told as needless.
  double needless_texels = 4;
  // Texels along a side of the largest page. Faces too big for it get coarser texels.
  int max_page_texels = 8192;
  // Texels around each chart that repeat its border, so that mipmaps and JPEG blocks stay clean.
  int gutter_texels = 8;
  // 16: photographs are read, and pages made, with 16 bits a channel (TexturePage::srgb16); takes
  // twice the memory for both.
  int bits = 8;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "page options: ") const;
};

}  // namespace groundglass
