// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/feature_edges.h"
#include "scene/polygon_model.h"

#include <vector>

namespace groundglass {

// For each edge a number, the same for edges whose face looks the same way (to 45 degrees) and that
// are both upright or both not: what is built alike errs alike, as all window sills of a facade do.
std::vector<int> FindEdgeClusters(const PolygonModel& model, const std::vector<ModelEdge>& edges);

}  // namespace groundglass
