// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts/charts.h"

#include <vector>

namespace groundglass {

struct PageSize {
  int width = 0;
  int height = 0;
};

// Places the charts that have a texel size on as few pages as it can, a gutter around each; the
// pages' sides are multiples of 16 up to max_page_texels. Every chart with its gutters must fit.
std::vector<PageSize> PackCharts(std::vector<Chart>& charts,
                                 int gutter_texels,
                                 int max_page_texels);

}  // namespace groundglass
