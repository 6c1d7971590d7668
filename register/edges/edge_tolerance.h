// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/feature_edges.h"
#include "scene/polygon_model.h"

#include <vector>

namespace groundglass {

struct EdgeTolerance {
  double sigma = 0;        // in the model's unit
  bool on_ground = false;  // where a wall meets the ground
};

// For each edge, how far the building may lie from it by the model's own making, 0 for most:
// - Flat facets stand for a rounded corner. Where they meet there is no line, and the surface
//   bulges out of them by the arc's sagitta, half the chord times tan(a / 4) for facets that turn
//   by the angle a.
// - Where walls meet the ground, soil, plinth and plants do not follow the plan: boundary edges on
//   the model's lowest level.
// Both grow with the model's sigma where that is larger than what its size suggests.
std::vector<EdgeTolerance> FindEdgeTolerances(const PolygonModel& model,
                                              const std::vector<ModelEdge>& edges);

}  // namespace groundglass
