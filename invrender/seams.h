// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/cells.h"
#include "invrender/choose.h"
#include "invrender/colour.h"

namespace groundglass {

// Moves the seams of a choice to where the photographs on both sides look alike, and drops islands
// that gain little: alpha expansion (Boykov, Veksler and Zabih, PAMI 2001) over the cells, with
// the seam's cost of Kwatra and others (SIGGRAPH 2003, section 3).
void SmoothSeams(const ChartCells& cells,
                 int chart,
                 const ColourModel& colour,
                 ChartChoice& choice);

}  // namespace groundglass
