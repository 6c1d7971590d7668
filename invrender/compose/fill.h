// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/compose/chart_pixels.h"
#include "invrender/inputs/fill_options.h"

namespace groundglass {

// Paints over the open texels of a chart from what lies around them (Telea, J. Graphics Tools
// 2004), and marks them kProvenanceFilled. A chart with nothing to start from stays as it is.
void FillOpenTexels(const FillOptions& options, ChartPixels& pixels);

}  // namespace groundglass
