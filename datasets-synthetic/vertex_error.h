// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/polygon_model.h"

namespace groundglass {

// How far the model's points move in the picture between two cameras: over all points in front of
// both and, for the true one, inside the frame; hidden points count.
struct VertexError {
  double mean_px = 0;
  double max_px = 0;
  int num_points = 0;  // 0: no point in the frame, and no error to speak of
};
VertexError MeasureVertexError(const PolygonModel& model,
                               const Camera& true_camera,
                               const Camera& found_camera);

}  // namespace groundglass
