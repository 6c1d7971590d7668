// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <random>

namespace groundglass {

// Uniform in [least, most), the same with every standard library.
inline double DrawBetween(std::mt19937_64& random, double least, double most) {
  return least + (most - least) * static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace groundglass
