// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <algorithm>
#include <vector>

namespace groundglass {

template <typename T>
struct WeightedValue {
  T value = 0;
  T weight = 0;
};

// The smallest value with this share of the weight at or below it; `fallback` if there is none.
// Sorts.
template <typename T>
T WeightedQuantile(std::vector<WeightedValue<T>>& values, double share, T fallback) {
  std::sort(values.begin(), values.end(), [](const WeightedValue<T>& a, const WeightedValue<T>& b) {
    return a.value < b.value;
  });
  double total = 0;
  for (const WeightedValue<T>& value : values) total += value.weight;
  double sum = 0;
  for (const WeightedValue<T>& value : values) {
    sum += value.weight;
    if (sum >= share * total) return value.value;
  }
  return fallback;
}

template <typename T>
T WeightedMedian(std::vector<WeightedValue<T>>& values, T fallback) {
  return WeightedQuantile(values, 0.5, fallback);
}

}  // namespace groundglass
