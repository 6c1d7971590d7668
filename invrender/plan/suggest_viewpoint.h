// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/coverage_options.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <optional>

namespace groundglass {

// From where a place on a face could be photographed: before the face, as square to it as can be,
// as far as the face is large, with nothing of the model between; at eye level above
// the model's lowest point if that works. Nothing if every such place is hidden, under the ground
// or under a roof.
std::optional<Eigen::Vector3d> SuggestViewpoint(const PolygonModel& model,
                                                const Visibility& visibility,
                                                int face,
                                                const Eigen::Vector3d& target_in_world,
                                                const ViewpointOptions& options = {});

}  // namespace groundglass
