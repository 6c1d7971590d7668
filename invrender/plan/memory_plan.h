// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts/charts.h"
#include "invrender/inputs/memory_options.h"
#include "invrender/inputs/page_options.h"
#include "invrender/photos/prepared_photo.h"

#include <cstddef>
#include <vector>

namespace groundglass {

// How a bake stays within a limit of memory.
struct MemoryPlan {
  double texel_scale = 1;  // texels this many times as long as without the limit
  size_t photo_bytes = 0;  // for decoded photographs
  int num_dropped = 0;     // of the photographs' finest levels, which such texels do not show
  int mask_halvings = 0;   // MaskDetail::num_halvings
  int num_at_once = 1;     // photographs that may be read and masked at the same time
  size_t chart_bytes = 0;  // for charts at work, ChartBytes of each; the largest alone fits
};

// Masks whose sides are halved so often are quickly made, and tell what finer ones would take.
constexpr int kSurveyHalvings = 2;

// What all masks would take after so many halvings, from those of a survey; rather more than less
// (mask_estimate_factor).
double EstimateMaskBytes(const std::vector<PreparedPhoto>& survey,
                         int num_halvings,
                         const MemoryOptions& options = {});

// A bake's plan before the work: from a survey (MaskDetail) with kSurveyHalvings, what masks of
// each coarseness would take; and what the pages, the blocks and the largest chart at work take.
// The rest is for decoded photographs, which come and go; where that is too little for a few of
// them at once, texels become larger. Where texels become twice as long or more and photographs do
// not fit all at once, they are kept at half their size or less, if pages.texel_size does not ask
// for a certain one. Masks become coarser where that is worth it (worth_halving). The charts have
// their texel sizes. Throws Error if options.max_memory_mb is below what any bake of these
// photographs needs.
MemoryPlan PlanMemory(const std::vector<Chart>& charts,
                      const std::vector<PreparedPhoto>& survey,
                      const PageOptions& pages,
                      const MemoryOptions& options);

// The same once the masks are made as `plan` says: its texel_scale, photo_bytes and chart_bytes
// follow from what they really take.
MemoryPlan RevisePlan(const MemoryPlan& plan,
                      const std::vector<Chart>& charts,
                      const std::vector<PreparedPhoto>& photos,
                      const PageOptions& pages,
                      const MemoryOptions& options);

// What a chart that so many photographs see takes while it is laid out, beside its place on a page.
// bits: PageOptions::bits.
size_t ChartBytes(const Chart& chart, size_t num_views, int bits);

}  // namespace groundglass
