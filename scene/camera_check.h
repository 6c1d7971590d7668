// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"

#include <string>

namespace groundglass {

// Whether what another program's file says can be a camera: one rule for all formats. The answers
// are empty, or what is wrong and what was expected, in words that follow "PLACE: ".

// No picture is longer, px; nor does a principal point lie farther from its corner.
inline constexpr int kLongestSidePx = 1 << 17;

// A picture's width and height: whole numbers from 1 to the longest side.
std::string FindSizeFault(double width_px, double height_px);

// Size, focal lengths, principal point, lens and pose; the first fault.
std::string FindCameraFault(const Camera& camera);

}  // namespace groundglass
