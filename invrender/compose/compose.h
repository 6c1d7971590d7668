// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/colour/colour.h"
#include "invrender/compose/chart_pixels.h"
#include "invrender/compose/compose_inputs.h"
#include "invrender/inputs/blend_options.h"

namespace groundglass {

// ComposeChart looks texels up in bands of so many, or of a few rows.
constexpr int kBandTexels = 1 << 20;

// Fills a chart at full resolution: each texel from the photographs that its block and the blocks
// around it chose, blended across the seam between them, and from the others where those do not
// see it. Colours are corrected and in the chart's own light. bits: PageOptions::bits.
ChartPixels ComposeChart(const ComposeInputs& inputs,
                         const ColourModel& colour,
                         const BlendOptions& options,
                         int bits);

}  // namespace groundglass
