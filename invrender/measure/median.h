// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace groundglass {

// The value at `rank` of what would be in order, which reorders the values; there must be more than
// `rank`.
template <typename Value>
Value ValueAtRank(std::vector<Value>& values, size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The middle value, and of an even number the larger or the smaller of the two in the middle.
// Reorders the values, of which there must be some.
template <typename Value>
Value Median(std::vector<Value>& values) {
  return ValueAtRank(values, values.size() / 2);
}
template <typename Value>
Value LowerMedian(std::vector<Value>& values) {
  return ValueAtRank(values, (values.size() - 1) / 2);
}

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
