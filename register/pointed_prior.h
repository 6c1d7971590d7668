// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera_prior.h"
#include "register/control_points.h"
#include "register/edge_samples.h"

#include <vector>

namespace groundglass {

// What is known of the camera once a person has pointed, before looking for edges: where to search.
struct PointedPrior {
  CameraPrior prior;
  // The same as an affine map between whitened parameters: u = offset + map v, v those of `prior`,
  // u those of the prior from the tag.
  CameraParameters offset = CameraParameters::Zero();
  CameraCovariance map = CameraCovariance::Identity();
};

// The prior from the tag, narrowed by the points (the most likely camera, and its covariance to
// first order). Without points, or if one lies behind the tag's camera, it is the tag's own.
// Points in pixels of the prior's picture.
PointedPrior NarrowByPoints(const std::vector<ControlPoint>& points, const CameraPrior& prior);

// How much narrower the search has become: the ratio of the root mean square uncertainties of the
// samples along their normals, after and before; at most 1.
double NarrowingOf(const PointedPrior& pointed,
                   const CameraPrior& prior,
                   const std::vector<EdgeSample>& samples);

// Log density, up to a constant, of what was pointed at, seen from a camera, in nats: minus half
// the sum of the squared residuals in sigmas. A point behind the camera counts as 1000 sigmas off.
double ControlPointNats(const std::vector<ControlPoint>& points,
                        const ParameterProjection& projection);

// Sends a registration to review, with the reason, if a point lies further than max_sigmas from
// where the camera sees it: somebody mistyped it or pointed at something else.
// scale: pixels of the points per pixel of the photograph.
void JudgeControlPoints(const std::vector<ControlPoint>& points,
                        const ParameterProjection& projection,
                        double scale,
                        double max_sigmas,
                        Registration& registration);

}  // namespace groundglass
