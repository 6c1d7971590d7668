// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"

namespace groundglass {

// The bounds of what is built: without faces that lie flat and are each ten times as large as all
// smaller faces together, as a ground or a piece of terrain that runs far beyond the building.
// Lengths that go by the building's size (tolerances, the unit that it suggests, where to look at)
// are taken from these; ComputeBounds where there is no such face.
Box ComputeBuildingBounds(const PolygonModel& model);

}  // namespace groundglass
