// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts/charts.h"
#include "invrender/inputs/block_options.h"
#include "invrender/measure/chart_blocks.h"
#include "invrender/photos/prepared_photo.h"

#include <vector>

namespace groundglass {

// The photographs that may see some of the chart, ascending.
std::vector<int> FindPhotosOfChart(const Chart& chart,
                                   int chart_index,
                                   const std::vector<PreparedPhoto>& photos);

// Looks every block of every chart up in every photograph, photograph by photograph, so that each
// is decoded once; charts that have no page stay empty.
std::vector<ChartBlocks> ObserveBlocks(const PolygonModel& model,
                                       const std::vector<Chart>& charts,
                                       const std::vector<PreparedPhoto>& photos,
                                       const BlockOptions& options);

}  // namespace groundglass
