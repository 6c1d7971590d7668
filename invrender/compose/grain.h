// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts/charts.h"
#include "invrender/colour/colour.h"
#include "invrender/compose/chart_pixels.h"
#include "invrender/inputs/detail_options.h"
#include "invrender/measure/chart_blocks.h"
#include "invrender/measure/patch.h"

#include <array>
#include <vector>

namespace groundglass {

// Detail is taken apart into two bands of a picture: what a binomial filter of five samples takes
// away, and what the same filter over every second sample then takes away (a-trous wavelets;
// Starck and Murtagh 1994).
constexpr int kGrainBands = 2;

struct Grain {
  // The grain's variance in each band of each photograph's luma, (sRGB code / 255)^2, the finest
  // band first, at steps of a pixel.
  std::vector<std::array<double, kGrainBands>> variances;
  // For each chart, how surely its faintest detail is grain: 1 where photographs have nothing of
  // it in common, 0 where they agree on it, as on brick.
  std::vector<double> certainty;
};

// What photographs of one patch do not have in common is grain: least squares over the pairs of
// photographs, from each pair's calmer patches, so that cameras that are off and relief count
// little. Certainty is the correlation of what two photographs show, again in the calmer patches,
// at the best shift of up to three pixels for each chart and pair, so that it hardly depends on
// cameras either; charts with few patches lean on the others.
Grain MeasureGrain(const std::vector<Patch>& patches,
                   size_t num_charts,
                   size_t num_photos,
                   const GrainOptions& options);

// A chart with what is known of its grain. All must outlive the work.
struct GrainInputs {
  const Chart& chart;
  int chart_index;
  const ChartBlocks& blocks;
  const ColourModel& colour;  // what the texels were corrected by
  const Grain& grain;
};

// Lowers the grain of a chart's texels: each band of their luma is multiplied by the share of its
// energy thereabouts that is more than grain (Wiener's filter; Lee, PAMI 1980), so that lines and
// edges stay as they are. Texels' photographs are taken from the provenance.
void SmoothGrain(const GrainInputs& inputs, const GrainOptions& options, ChartPixels& pixels);

}  // namespace groundglass
