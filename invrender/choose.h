// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/cells.h"
#include "invrender/colour.h"
#include "invrender/invrender.h"
#include "invrender/sharpness.h"

#include <vector>

namespace groundglass {

// Which photograph textures each cell of a chart.
struct ChartChoice {
  std::vector<int> best;          // per cell: k in ChartCells::photos, or -1
  std::vector<float> acceptance;  // [cell * photos.size() + k]: 1 agrees with the consensus,
                                  // towards 0 something else stands there, or it is blurred
};

// Picks by resolution, angle and distance to borders (CellView::quality), against photographs that
// differ from the consensus of the others or are blurred (`sharpness`: for each photograph; empty:
// all alike); then seams are smoothed.
ChartChoice ChooseCells(const ChartCells& cells,
                        int chart,
                        const ColourModel& colour,
                        const std::vector<Sharpness>& sharpness,
                        const BakeOptions& options);

}  // namespace groundglass
