// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

namespace groundglass {

// A picture made smaller: each new pixel is the mean of the LIGHT of the area that it covers.
// Averages of sRGB codes would come out too dark beside anything bright, and would move edges
// towards their dark side. Any number of channels, all of sRGB codes. width, height: at least 1 and
// at most the picture's own.
Image8 ReducedInLight(const Image8& srgb8, int width, int height);

}  // namespace groundglass
