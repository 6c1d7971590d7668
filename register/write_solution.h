// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/joint_refinement.h"
#include "register/parameter_projection.h"
#include "scene/polygon_model.h"
#include "scene/registration.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// Mean distance between points as two cameras project them, px of the cameras' pictures.
double MeanDisplacementPx(const std::vector<Eigen::Vector3d>& points_in_world,
                          const ParameterProjection& one,
                          const ParameterProjection& other);

// Writes a solution into a registration: the corrected tag, covariance, residuals, how far points
// that the photograph shows have moved, and how well the model's points are known. The
// registration has its sizes, which may be a multiple of those of the prior's picture, and its
// measured tag.
void WriteSolution(const JointSolution& solution,
                   const CameraPrior& prior,
                   const PolygonModel& model,
                   const std::vector<Eigen::Vector3d>& points_in_world,
                   Registration& registration);

}  // namespace groundglass
