// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/mesh_io.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace groundglass {

double OrNoPlace(double coordinate) {
  return std::isfinite(coordinate) ? coordinate : std::numeric_limits<double>::infinity();
}

void JoinIdenticalPoints(PolygonModel& model) {
  std::map<std::array<double, 3>, int> joined;
  std::vector<Eigen::Vector3d> points;
  std::vector<int> new_index(model.points_in_world.size());
  for (size_t i = 0; i < model.points_in_world.size(); ++i) {
    const Eigen::Vector3d& point = model.points_in_world[i];
    const auto [place, is_new] =
        joined.try_emplace({point.x(), point.y(), point.z()}, static_cast<int>(points.size()));
    if (is_new) points.push_back(point);
    new_index[i] = place->second;
  }
  model.points_in_world = std::move(points);
  for (Face& face : model.faces) {
    for (int& point : face.points) {
      if (point >= 0) point = new_index[static_cast<size_t>(point)];
    }
  }
}

}  // namespace groundglass
