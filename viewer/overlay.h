// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/feature_edges.h"
#include "scene/image.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

#include <Eigen/Dense>

#include <functional>
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

// The same with either camera left out (null).
struct OverlayCameras {
  const Camera* measured = nullptr;
  const Camera* corrected = nullptr;
};
Image8 DrawOverlay(const Image8& photograph_srgb8,
                   const PolygonModel& model,
                   const std::vector<ModelEdge>& edges,
                   const Visibility& visibility,
                   const OverlayCameras& cameras);

// A function that finds one model's edges as a camera sees them, hidden ones removed: lines of
// image points, px, bent as the lens bends them. It holds what is visible from where, and the model
// must outlive it.
std::function<std::vector<std::vector<Eigen::Vector2d>>(const Camera& camera)> MakeEdgeFinding(
    const PolygonModel& model);

}  // namespace groundglass
