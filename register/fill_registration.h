// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/joint/joint_refinement.h"
#include "register/verdict/verdict.h"
#include "scene/polygon_model.h"
#include "scene/registration.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// Fills a registration from a solution: the corrected tag, covariance, residuals, how far points
// that the photograph shows have moved, and how well the model's points are known. The
// registration has its sizes, which may be a multiple of those of the prior's picture, and its
// measured tag.
void FillRegistration(const JointSolution& solution,
                      const CameraPrior& prior,
                      const PolygonModel& model,
                      const std::vector<Eigen::Vector3d>& points_in_world,
                      Registration& registration);

// What is claimed for a camera that a registration has, with a further covariance (of the
// parameters as they are in the tag) joined to it.
void AddToCovariance(const CameraCovariance& added,
                     const CameraPrior& prior,
                     const CameraParameters& whitened,
                     const PolygonModel& model,
                     Registration& registration);

// Writes down what speaks for the camera.
void RecordEvidence(const Evidence& evidence, Registration& registration);

}  // namespace groundglass
