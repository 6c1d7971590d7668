// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts/charts.h"
#include "invrender/measure/chart_blocks.h"
#include "invrender/photos/prepared_photo.h"
#include "invrender/select/chart_choice.h"

#include <vector>

namespace groundglass {

// A chart with what is known of it when its texels are looked up. All must outlive the work.
struct ComposeInputs {
  const Chart& chart;
  int chart_index;
  const ChartTexels& texels;
  const std::vector<PreparedPhoto>& photos;
  double border_margin_px;  // PhotoOptions, of all of them
  const ChartBlocks& blocks;
  const ChartChoice& choice;
};

}  // namespace groundglass
