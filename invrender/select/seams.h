// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/colour/colour.h"
#include "invrender/inputs/seam_options.h"
#include "invrender/measure/chart_blocks.h"
#include "invrender/select/chart_choice.h"

namespace groundglass {

// Moves the seams of a choice to where the photographs on both sides look alike, and drops islands
// that gain little: alpha expansion (Boykov, Veksler and Zabih, PAMI 2001) over the blocks, with
// the seam's cost of Kwatra and others (SIGGRAPH 2003, section 3).
void SmoothSeams(const ChartBlocks& blocks,
                 int chart,
                 const ColourModel& colour,
                 const SeamOptions& options,
                 ChartChoice& choice);

}  // namespace groundglass
