// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/srgb.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace groundglass {

// sRGB codes of 8 or 16 bits and radiance, by tables: this is done for every tap of every texel.

// The radiance of each code, by code.
template <typename Code>
const float* RadianceOfCodes() {
  if constexpr (std::is_same_v<Code, uint8_t>) {
    return LinearOfSrgb8().data();
  } else {
    static_assert(std::is_same_v<Code, uint16_t>);
    constexpr int kNumCodes = 65536;
    static const std::vector<float> table = [] {
      std::vector<float> values(kNumCodes);
      for (int i = 0; i < kNumCodes; ++i) {
        values[i] = LinearFromSrgb(static_cast<float>(i) / (kNumCodes - 1));
      }
      return values;
    }();
    return table.data();
  }
}

// Radiance to 8-bit sRGB, rounded to the nearest of so many steps of light first, which is quicker
// than Srgb8FromLinear (scene/srgb.h).
class Srgb8Encoder {
 public:
  Srgb8Encoder();
  // radiance: from 0 to 1.
  uint8_t InRange(float radiance) const {
    return codes_[static_cast<size_t>(radiance * kSteps + 0.5f)];
  }

 private:
  static constexpr int kSteps = 16384;
  const uint8_t* codes_;
};

// Rounded; values are clamped to [0, 1].
uint8_t Srgb8FromRadiance(float radiance);
void Srgb8FromRadiance(std::span<const float> radiance, uint8_t* srgb8);
uint16_t Srgb16FromRadiance(float radiance);

}  // namespace groundglass
