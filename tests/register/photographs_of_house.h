// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/align_photograph.h"
#include "tests/register/house.h"

#include <vector>

namespace groundglass {

// Four cameras on the house's south side: `site` counts y southwards.
std::vector<ViewTag> TrueTagsOfHouse();

// The tags as a tape has them.
std::vector<ViewTag> MeasuredTagsOfHouse();

// The four photographs of the house as it was built, each aligned by itself from its measured tag.
std::vector<PhotographAlignment> AlignPhotographsOfHouse(const PolygonModel& built,
                                                         const EdgeModel& edge_model);

// How far these cameras lie from the true ones, px, on average.
double MeanVertexErrorOfHousePx(const PolygonModel& model,
                                const std::vector<PhotographAlignment>& alignments);

// The house as built: its lean-to is 0.3 ft higher than in the plan.
PolygonModel WithAHigherShed(PolygonModel model);

}  // namespace groundglass
