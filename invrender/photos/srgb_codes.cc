// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/photos/srgb_codes.h"

#include <algorithm>
#include <cmath>

namespace groundglass {

Srgb8Encoder::Srgb8Encoder() {
  static const std::vector<uint8_t> table = [] {
    std::vector<uint8_t> codes(kSteps + 1);
    for (int i = 0; i <= kSteps; ++i) {
      const float encoded = SrgbFromLinear(static_cast<float>(i) / kSteps);
      codes[i] = static_cast<uint8_t>(std::lround(255 * encoded));
    }
    return codes;
  }();
  codes_ = table.data();
}

uint8_t Srgb8FromRadiance(float radiance) {
  uint8_t code = 0;
  Srgb8FromRadiance({&radiance, 1}, &code);
  return code;
}

void Srgb8FromRadiance(std::span<const float> radiance, uint8_t* srgb8) {
  const Srgb8Encoder encode;
  for (const float value : radiance) *srgb8++ = encode.InRange(std::clamp(value, 0.0f, 1.0f));
}

uint16_t Srgb16FromRadiance(float radiance) {
  return static_cast<uint16_t>(65535 * SrgbFromLinear(radiance) + 0.5f);
}

}  // namespace groundglass
