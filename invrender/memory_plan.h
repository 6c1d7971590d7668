// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts.h"
#include "invrender/prepared_photo.h"

#include <cstddef>
#include <vector>

namespace groundglass {

// How a bake stays within a limit of memory.
struct MemoryPlan {
  double texel_scale = 1;  // texels this many times as long as without the limit
  size_t photo_bytes = 0;  // for decoded photographs
  int num_dropped = 0;     // of the photographs' finest levels, which such texels do not show
};

// Sums up what the pages, the cells, the largest chart at work and the photographs' masks take, and
// leaves the rest to decoded photographs, which come and go; where that is too little for a few of
// them at once, texels become larger. Where texels become twice as long or more and photographs do
// not fit all at once, they are kept at half their size or less, if `may_drop`: the texels do not
// follow from an option, but from the photographs' pixels. The charts have their texel sizes.
// Throws Error if the limit is below what any bake of these photographs needs.
MemoryPlan PlanMemory(const std::vector<Chart>& charts,
                      const std::vector<PreparedPhoto>& photos,
                      size_t max_bytes,
                      int bits,
                      bool may_drop);

}  // namespace groundglass
