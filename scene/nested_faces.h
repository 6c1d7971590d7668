// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/polygon_model.h"

#include <vector>

namespace groundglass {

// A face that lies wholly within another one, in its plane and with its front on the same side: a
// pane laid into a wall that has no hole for it. Where they lie on one another it is chance which
// of the two is seen.
struct NestedFace {
  int inner = -1;
  int outer = -1;
};
// Of these sound faces, in the order of the inner one, then the outer one: a pane in a window in a
// wall lies in both.
std::vector<NestedFace> FindNestedFaces(const PolygonModel& model, const std::vector<int>& faces);

}  // namespace groundglass
