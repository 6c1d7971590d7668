// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/mean_displacement.h"

namespace groundglass {

double MeanDisplacementPx(const std::vector<Eigen::Vector3d>& points_in_world,
                          const ParameterProjection& one,
                          const ParameterProjection& other) {
  double sum = 0;
  int count = 0;
  for (const Eigen::Vector3d& point : points_in_world) {
    const auto a = one.ImageOf(point);
    const auto b = other.ImageOf(point);
    if (!a || !b) continue;
    sum += (*a - *b).norm();
    ++count;
  }
  return count ? sum / count : 0;
}

}  // namespace groundglass
