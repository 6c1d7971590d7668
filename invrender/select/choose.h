// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/colour/colour.h"
#include "invrender/inputs/consistency_options.h"
#include "invrender/measure/chart_blocks.h"
#include "invrender/measure/sharpness.h"
#include "invrender/select/chart_choice.h"

#include <vector>

namespace groundglass {

// How well each view agrees with the consensus of the others, ChartChoice::consistency; 1 for a
// photograph that is alone.
std::vector<float> MeasureConsistency(const ChartBlocks& blocks,
                                      int chart,
                                      const ColourModel& colour,
                                      const ConsistencyOptions& options);

// Lowers the consistency of blurred photographs where several look (fewest_to_compare).
// `sharpness`: for each photograph.
void PreferSharp(const ChartBlocks& blocks,
                 const std::vector<Sharpness>& sharpness,
                 const ConsistencyOptions& options,
                 std::vector<float>& consistency);

// Picks by resolution, angle and distance to borders (BlockView::quality), times consistency.
ChartChoice ChooseBlocks(const ChartBlocks& blocks, std::vector<float> consistency);

}  // namespace groundglass
