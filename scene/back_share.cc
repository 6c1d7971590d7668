// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/back_share.h"

#include <cmath>
#include <numbers>

namespace groundglass {

double BackShare(const Visibility& visibility,
                 const Eigen::Vector3d& position_in_world,
                 const Eigen::Matrix3d& world_from_turned,
                 bool flips_faces) {
  constexpr int kDirections = 16;
  int num_backs = 0;
  int total = 0;
  for (const double height : {0.02, 0.35}) {
    for (int i = 0; i < kDirections; ++i, ++total) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / kDirections;
      const Eigen::Vector3d direction =
          (world_from_turned * Eigen::Vector3d(std::cos(angle), std::sin(angle), height))
              .normalized();
      const auto hit = visibility.FirstHit(position_in_world, direction);
      if (hit && hit->is_front == flips_faces) ++num_backs;
    }
  }
  return static_cast<double>(num_backs) / total;
}

}  // namespace groundglass
