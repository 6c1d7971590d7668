// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/outline_sides.h"

#include <map>
#include <utility>

namespace groundglass {

bool IsAnyRepeated(const std::vector<int>& weld) {
  for (size_t i = 0; i < weld.size(); ++i) {
    if (weld[i] != static_cast<int>(i)) return true;
  }
  return false;
}

std::vector<OutlineSide> AllSides(const std::vector<int>& weld) {
  std::vector<OutlineSide> sides;
  const int n = static_cast<int>(weld.size());
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    if (weld[i] != weld[next]) sides.push_back({i, next});
  }
  return sides;
}

std::vector<OutlineSide> WithoutBridges(const std::vector<OutlineSide>& sides,
                                        const std::vector<int>& weld) {
  std::map<std::pair<int, int>, std::vector<size_t>> open;  // not yet walked back
  std::vector<char> is_bridge(sides.size(), 0);
  for (size_t i = 0; i < sides.size(); ++i) {
    const std::pair<int, int> way(weld[sides[i].start], weld[sides[i].end]);
    const auto back = open.find({way.second, way.first});
    if (back != open.end() && !back->second.empty()) {
      is_bridge[i] = is_bridge[back->second.back()] = 1;
      back->second.pop_back();
    } else {
      open[way].push_back(i);
    }
  }
  std::vector<OutlineSide> left;
  for (size_t i = 0; i < sides.size(); ++i) {
    if (!is_bridge[i]) left.push_back(sides[i]);
  }
  return left;
}

std::vector<OutlineSide> FindBorders(const PolygonModel& model, int face) {
  std::vector<Eigen::Vector3d> corners;
  for (const int point : model.faces[face].points) corners.push_back(model.points_in_world[point]);
  const std::vector<int> weld = WeldCorners(corners);
  const std::vector<OutlineSide> sides = AllSides(weld);
  return IsAnyRepeated(weld) ? WithoutBridges(sides, weld) : sides;
}

}  // namespace groundglass
