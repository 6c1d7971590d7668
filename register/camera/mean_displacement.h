// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/parameter_projection.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// Mean distance between points as two cameras project them, px of the cameras' pictures; those
// that one of them does not see are left out. 0 if none is left.
double MeanDisplacementPx(const std::vector<Eigen::Vector3d>& points_in_world,
                          const ParameterProjection& one,
                          const ParameterProjection& other);

}  // namespace groundglass
