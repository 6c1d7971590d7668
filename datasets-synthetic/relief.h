// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/synthetic_world.h"

#include <cstdint>

namespace groundglass {

// Gives the photographed building what its model leaves out, as every real building has it: windows
// lie 0.3 to 0.6 ft times `depth` behind the wall, with reveals and sills, and rounded corners are
// round. The faces of the model keep their numbers; what is added comes last, and all of it is
// marked Surface::is_relief. Take the model first (SyntheticWorld::Model).
void AddRelief(double depth, const Rgb& reveal_color, uint64_t seed, SyntheticWorld& world);

// Takes away whatever could pull at an edge of the model without being one: every face gets one
// even colour that its neighbours in the model have not, the building's rectangles get blotches
// that keep off their borders, and nothing mirrors.
void PaintPlainly(uint64_t seed, SyntheticWorld& world);

}  // namespace groundglass
