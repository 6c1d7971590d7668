// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/vertex_error.h"

#include <algorithm>

namespace groundglass {

VertexError MeasureVertexError(const PolygonModel& model,
                               const Camera& true_camera,
                               const Camera& found_camera) {
  VertexError error;
  double sum_px = 0;
  for (const Eigen::Vector3d& point_in_world : model.points_in_world) {
    const auto true_px = Project(true_camera, point_in_world);
    if (!true_px || !IsInsideFrame(true_camera, *true_px)) continue;
    const auto found_px = Project(found_camera, point_in_world);
    if (!found_px) continue;
    const double distance_px = (*found_px - *true_px).norm();
    sum_px += distance_px;
    error.max_px = std::max(error.max_px, distance_px);
    ++error.num_points;
  }
  if (error.num_points > 0) error.mean_px = sum_px / error.num_points;
  return error;
}

}  // namespace groundglass
