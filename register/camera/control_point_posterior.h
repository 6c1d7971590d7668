// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/camera/control_points.h"

#include <vector>

namespace groundglass {

// What is known of the camera once a person has pointed, before looking for edges: where to search.
struct ControlPointPosterior {
  CameraPrior prior;
  // The same as an affine map between whitened parameters: u = offset + map v, v those of `prior`,
  // u those of the prior from the tag.
  CameraParameters offset = CameraParameters::Zero();
  CameraCovariance map = CameraCovariance::Identity();
};

// The prior from the tag, narrowed by the points (the most likely camera, and its covariance to
// first order). Without points, or if one lies behind the tag's camera, it is the tag's own.
// Points in pixels of the prior's picture.
ControlPointPosterior ConditionOnControlPoints(const std::vector<ControlPoint>& points,
                                               const CameraPrior& prior);

// Log density, up to a constant, of what was pointed at, seen from a camera, in nats: minus half
// the sum of the squared residuals in sigmas. A point behind the camera counts as 1000 sigmas off.
double ControlPointNats(const std::vector<ControlPoint>& points,
                        const ParameterProjection& projection);

}  // namespace groundglass
