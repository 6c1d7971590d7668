// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/feature_edges.h"
#include "scene/image.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <vector>

namespace groundglass {

// The model's edges, hidden ones removed, drawn over the photograph: as the measured camera sees
// them in grey, and as the corrected one does in colour (if there is one). Line widths follow the
// picture's size; silhouettes are a little wider; a legend stands in the bottom-left corner.
// photograph_srgb8: 3 channels, of both cameras' size, else Error.
Image8 DrawOverlay(const Image8& photograph_srgb8,
                   const PolygonModel& model,
                   const std::vector<ModelEdge>& edges,
                   const Visibility& visibility,
                   const Camera& measured,
                   const Camera* corrected);

// A span of the model's drawing as the camera's distortion bends it: image points, px, no further
// apart than a few pixels along a bent line; two points where lines stay straight.
std::vector<Eigen::Vector2d> ProjectSpan(const Camera& camera,
                                         const Eigen::Vector3d& start_in_world,
                                         const Eigen::Vector3d& end_in_world);

}  // namespace groundglass
