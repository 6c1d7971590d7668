// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <cmath>

namespace groundglass {

// A number as so many decimals show it: one that rounds to nothing has no sign, which printf would
// give it ("-0.00").
inline double ZeroIfRounded(double value, int decimals) {
  const double power = std::pow(10, decimals);
  return std::abs(value) * power < 0.5 ? 0.0 : value;
}

}  // namespace groundglass
