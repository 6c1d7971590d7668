// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "tests/bench/anchors/anchor_set.h"

namespace groundglass {

// A tiled facade of this project's own making, 640 x 427: the preset `wiesner`, whose 5 ft grid of
// joints is not in the model, with trees, lamps, signs, cars and people before it, grain and
// blur, shaken and defocused pictures; 23 photographs. The slides are where the lens put them, so
// the lens is exact. relief: 0 for a building that is its model, 1 for window bands that lie back
// and rounded corners that are round, which the model has not.
AnchorSet MakeFacade(double relief);

}  // namespace groundglass
