// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace groundglass {

// The smallest value with half of the weight at or below it; 0 if there is none. Sorts.
inline float WeightedMedian(std::vector<std::pair<float, float>>& value_and_weight) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double total = 0;
  for (const auto& [value, weight] : value_and_weight) total += weight;
  double sum = 0;
  for (const auto& [value, weight] : value_and_weight) {
    sum += weight;
    if (sum >= total / 2) return value;
  }
  return 0;
}

}  // namespace groundglass
