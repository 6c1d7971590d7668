// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/charts/spread_points.h"

#include <array>

namespace groundglass {

std::vector<Eigen::Vector3d> SpreadPoints(const PolygonModel& model, int face) {
  constexpr int kRows = 7;
  std::vector<Eigen::Vector3d> points;
  for (const std::array<int, 3>& triangle : TriangulateFace(model, face)) {
    const Eigen::Vector3d& a = model.points_in_world[triangle[0]];
    const Eigen::Vector3d& b = model.points_in_world[triangle[1]];
    const Eigen::Vector3d& c = model.points_in_world[triangle[2]];
    for (int i = 0; i < kRows; ++i) {
      for (int j = 0; j + i < kRows; ++j) {
        const double u = (i + 1.0 / 3) / kRows;
        const double v = (j + 1.0 / 3) / kRows;
        points.push_back(a + u * (b - a) + v * (c - a));
      }
    }
  }
  return points;
}

}  // namespace groundglass
