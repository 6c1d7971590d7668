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
};

// Sums up what the pages, the cells, the largest chart at work and the photographs' masks take, and
// leaves the rest to decoded photographs, which come and go; where that is too little for a few of
// them at once, texels become larger. The charts have their texel sizes. Throws Error if the limit
// is below what any bake of these photographs needs.
MemoryPlan PlanMemory(const std::vector<Chart>& charts,
                      const std::vector<PreparedPhoto>& photos,
                      size_t max_bytes,
                      int bits);

}  // namespace groundglass
