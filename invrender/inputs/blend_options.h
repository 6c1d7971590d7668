// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/sampling_options.h"

#include <string>

namespace groundglass {

// How texels are blended of the photographs that their blocks chose (Blender). Distances are in a
// photograph's pixels; `margin` is PhotoOptions::border_margin_px.
struct BlendOptions {
  // Whether photographs are blended in a band of one block along seams.
  bool across_seams = true;
  // So far beyond the margin a place is clear of borders, and its block's photograph alone will do.
  double clear_px = 1.5;
  // A chosen photograph's weight grows from nothing to all between ramp_start_px before the margin
  // and ramp_px later, and is nowhere less than least_border_weight.
  double ramp_start_px = 0.5;
  double ramp_px = 2;
  double least_border_weight = 1e-3;

  // Where the chosen ones have less weight than this together, the others are asked too.
  double enough_chosen = 0.5;
  // The others' share of what is missing. Small: they only matter where the chosen fail.
  double others_weight = 1e-2;
  // Added to the others' consistency, so that one that nobody agrees with is better than nothing.
  double least_consistency = 1e-6;
  // Photographs below this share of the largest weight are dropped.
  double negligible = 0.02;

  // A texel is good if a photograph of more than this weight shows it beyond the margin.
  double good_weight = 0.3;
  // Weak texels may take their colour from good ones as far away as the margin and this reach on
  // the chart, but for no more texels than farthest_reach.
  double reach_beyond_px = 1;
  int farthest_reach = 32;

  SamplingOptions sampling;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "blend options: ") const;
};

}  // namespace groundglass
