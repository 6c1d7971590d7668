// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/camera/control_point_posterior.h"
#include "register/edges/edge_samples.h"

#include <vector>

namespace groundglass {

// How much narrower the search has become by what a person pointed at: the ratio of the root mean
// square uncertainties of the samples along their normals, after and before; at most 1.
double UncertaintyRatio(const ControlPointPosterior& posterior,
                        const CameraPrior& prior,
                        const std::vector<EdgeSample>& samples);

}  // namespace groundglass
