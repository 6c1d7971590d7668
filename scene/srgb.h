// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

namespace groundglass {

// The sRGB transfer function (IEC 61966-2-1), on [0, 1]; what lies outside is clamped.
float LinearFromSrgb(float encoded);
float SrgbFromLinear(float linear);

}  // namespace groundglass
