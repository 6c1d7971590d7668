// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_clusters.h"

#include <cmath>
#include <numbers>

namespace groundglass {

std::vector<int> FindEdgeClusters(const PolygonModel& model, const std::vector<ModelEdge>& edges) {
  constexpr int kCompassPoints = 8;
  std::vector<int> clusters;
  clusters.reserve(edges.size());
  for (const ModelEdge& edge : edges) {
    const Eigen::Vector3d normal = ComputeFacePlane(model, edge.first_face).normal_in_world;
    int looks = kCompassPoints;  // up or down
    if (std::abs(normal.z()) < 0.7) {
      const double eighths = std::atan2(normal.y(), normal.x()) / (std::numbers::pi / 4);
      looks = (static_cast<int>(std::lround(eighths)) + kCompassPoints) % kCompassPoints;
    }
    const Eigen::Vector3d along = edge.end_in_world - edge.start_in_world;
    const bool is_upright = std::abs(along.z()) > 0.7 * along.norm();
    clusters.push_back(2 * looks + (is_upright ? 1 : 0));
  }
  return clusters;
}

}  // namespace groundglass
