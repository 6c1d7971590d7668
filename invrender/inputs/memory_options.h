// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// How a bake stays within a limit of memory (PlanMemory).
struct MemoryOptions {
  // At most this much memory for the whole program, millions of bytes; 0: no limit. Photographs are
  // decoded again when they are needed again, charts are done a few at a time, and where even
  // the pages are too large, texels become larger (BakeResult::texel_scale).
  int max_memory_mb = 0;

  // Decoded photographs: all of them, as far as this share of the limit goes, but at least a few.
  // Raise both where decoding again takes too long.
  double photo_share = 0.3;
  double few_photos = 3;
  // Texels this much longer are no texture any more.
  double max_texel_scale = 8;
  // Photographs and masks are kept with their sides halved so often at most.
  int max_halvings = 3;
  // Texels this much longer are a fair price for photographs that are at hand.
  double worth_dropping = 1.15;
  // Masks may become coarser where texels become shorter by this much.
  double worth_halving = 1.1;
  // What is estimated of masks from a survey may be wrong by this much.
  double mask_estimate_factor = 1.3;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "memory options: ") const;
};

}  // namespace groundglass
