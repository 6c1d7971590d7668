// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/polygon_model.h"

#include <optional>
#include <vector>

namespace groundglass {

// A face's outline without what other faces of its plane cover (FindNestedFaces): with a hole for a
// pane that lies in the middle of a wall, with a notch for a door that stands on its border.
// Corners that the outline lacks are added to the model's points. Nothing, and the model as it was,
// if nothing is left of the face or if it falls into pieces.
std::optional<std::vector<int>> CutOutline(int face,
                                           const std::vector<int>& within,
                                           PolygonModel& model);

}  // namespace groundglass
