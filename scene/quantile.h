// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

namespace groundglass {

// The value that has this place once all are sorted; `rank` counts from 0.
template <typename T>
T ValueOfRank(std::vector<T> values, size_t rank) {
  assert(rank < values.size());
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// The middle value, of an even number the higher one of the two; `values` must not be empty.
template <typename T>
T UpperMedian(std::vector<T> values) {
  const size_t middle = values.size() / 2;
  return ValueOfRank(std::move(values), middle);
}

}  // namespace groundglass
