// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <array>

namespace groundglass {

// Catmull-Rom weights of the four neighbours at -1, 0, 1, 2 for a position t in [0, 1).
inline std::array<float, 4> CubicWeights(float t) {
  const float t2 = t * t;
  const float t3 = t2 * t;
  return {-0.5f * t3 + t2 - 0.5f * t,
          1.5f * t3 - 2.5f * t2 + 1,
          -1.5f * t3 + 2 * t2 + 0.5f * t,
          0.5f * t3 - 0.5f * t2};
}

}  // namespace groundglass
