// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/visibility.h"

#include <Eigen/Dense>

namespace groundglass {

// The share of directions about the horizon, level and upwards, in which the back of a face is met
// first, 0 to 1: near 1 within a building. `world_from_turned` turns the directions where the model
// is read as turned (Identity: as it is); flips_faces: its fronts are then the backs.
double BackShare(const Visibility& visibility,
                 const Eigen::Vector3d& position_in_world,
                 const Eigen::Matrix3d& world_from_turned = Eigen::Matrix3d::Identity(),
                 bool flips_faces = false);

}  // namespace groundglass
