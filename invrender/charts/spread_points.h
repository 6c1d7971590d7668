// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// Points spread over a face, some 28 in each of its triangles.
std::vector<Eigen::Vector3d> SpreadPoints(const PolygonModel& model, int face);

}  // namespace groundglass
