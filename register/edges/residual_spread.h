// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/weighted_quantile.h"

#include <vector>

namespace groundglass {

// How residuals scatter, px.
struct ResidualSpread {
  double rms_px = 0;  // root of the weighted mean square
  // 1.4826 times the weighted median of their absolute values: one standard deviation of normal
  // residuals, whatever a few others do.
  double robust_sigma_px = 0;
};
// value: a residual, px, of either sign. There must be one of weight above 0.
ResidualSpread MeasureSpread(std::vector<WeightedValue<double>> residuals);

}  // namespace groundglass
