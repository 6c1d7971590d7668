// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "ask/survey.h"

namespace groundglass {

// A wall in the plane y = 0, 40 wide and 20 high, its front to the south; a box of 4 x 4 x 4 stands
// 6 to 10 before it. "front" stands 30 before its middle and looks at it square on; "side" stands
// to the east; "flat" looks along it; "back" stands behind it; "away" looks the other way.
Survey MakeWallSurvey();

constexpr int kWallFace = 0;

}  // namespace groundglass
