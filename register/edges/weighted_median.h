// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <algorithm>
#include <vector>

namespace groundglass {

struct WeightedValue {
  double value = 0;
  double weight = 0;
};

// The value below which half of the weight lies; `fallback` if there is none.
inline double WeightedMedian(std::vector<WeightedValue> values, double fallback) {
  std::sort(values.begin(), values.end(), [](const WeightedValue& a, const WeightedValue& b) {
    return a.value < b.value;
  });
  double total = 0;
  for (const WeightedValue& value : values) total += value.weight;
  double below = 0;
  for (const WeightedValue& value : values) {
    below += value.weight;
    if (below >= total / 2) return value.value;
  }
  return fallback;
}

}  // namespace groundglass
