// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/face_outline.h"

#include <Eigen/Dense>

#include <algorithm>
#include <numeric>
#include <vector>

namespace groundglass {

inline double Cross2(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// One number for all corners at exactly the same place: that of the first.
template <typename Point>
std::vector<int> WeldCorners(const std::vector<Point>& corners) {
  std::vector<int> order(corners.size());
  std::iota(order.begin(), order.end(), 0);
  const auto compare = [&](int a, int b) {
    for (int axis = 0; axis < corners[a].size(); ++axis) {
      if (corners[a][axis] != corners[b][axis]) {
        return corners[a][axis] < corners[b][axis] ? -1 : 1;
      }
    }
    return 0;
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const int sign = compare(a, b);
    return sign != 0 ? sign < 0 : a < b;
  });
  std::vector<int> weld(corners.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && compare(order[i - 1], order[i]) == 0;
    weld[order[i]] = is_same ? weld[order[i - 1]] : order[i];
  }
  return weld;
}

bool IsAnyRepeated(const std::vector<int>& weld);

// All sides of an outline but for those of no length.
std::vector<OutlineSide> AllSides(const std::vector<int>& weld);

// The sides that are not walked the other way as well.
std::vector<OutlineSide> WithoutBridges(const std::vector<OutlineSide>& sides,
                                        const std::vector<int>& weld);

}  // namespace groundglass
