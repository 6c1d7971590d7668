// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/residual_spread.h"

#include <cmath>

namespace groundglass {

ResidualSpread MeasureSpread(std::vector<WeightedValue<double>> residuals) {
  double weights = 0;
  double squares = 0;
  for (WeightedValue<double>& residual : residuals) {
    weights += residual.weight;
    squares += residual.weight * residual.value * residual.value;
    residual.value = std::abs(residual.value);
  }
  return {std::sqrt(squares / weights), 1.4826 * WeightedMedian(residuals, 0.0)};
}

}  // namespace groundglass
