// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <array>
#include <cstdint>

namespace groundglass {

// The sRGB transfer function (IEC 61966-2-1), on [0, 1]; what lies outside is clamped.
float LinearFromSrgb(float encoded);
float SrgbFromLinear(float linear);

// The same for whole codes: the light of each 8-bit one, and the code that is nearest to a light.
const std::array<float, 256>& LinearOfSrgb8();
uint8_t Srgb8FromLinear(float linear);

// What red, green and blue contribute to the brightness of linear light, or of codes (ITU-R
// BT.709).
inline constexpr std::array<float, 3> kLumaWeights = {0.2126f, 0.7152f, 0.0722f};
inline float Luma(float red, float green, float blue) {
  return kLumaWeights[0] * red + kLumaWeights[1] * green + kLumaWeights[2] * blue;
}

}  // namespace groundglass
