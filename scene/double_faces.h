// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/polygon_model.h"

#include <vector>

namespace groundglass {

// Of these sound faces, which lie twice: between the same places, whichever way round. For each
// face of the model the first of `faces` that is the same; -1 for that one, and where there is
// none.
std::vector<int> FindDoubleFaces(const PolygonModel& model, const std::vector<int>& faces);

}  // namespace groundglass
