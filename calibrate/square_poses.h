// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// The poses (cam_from_world) that the picture of a square allows, the better fitting first: two, or
// one where they are the same (Collins & Bartoli, IJCV 2014). Corners of the square, and of its
// picture in pixels (x0 y0 x1 y1 ...): top left, top right, bottom right, bottom left. `lens`:
// intrinsics only.
std::vector<RigidTransform> FindSquarePoses(const Eigen::Matrix<double, 3, 4>& corners_in_world,
                                            const Eigen::Matrix<double, 8, 1>& corners_px,
                                            const Camera& lens);

}  // namespace groundglass
