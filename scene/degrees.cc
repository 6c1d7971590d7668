// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/degrees.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace groundglass {

bool SeemInDegrees(const Box& bounds) {
  constexpr double kLongest = 180;
  constexpr double kHighest = 90;
  constexpr double kWidest = 0.02;   // two kilometres: a tile of a city
  constexpr double kSlimmest = 100;  // height over width, which nothing built has
  const auto furthest = [&](int axis) {
    return std::max(std::abs(bounds.min[axis]), std::abs(bounds.max[axis]));
  };
  const double lesser = std::min(furthest(0), furthest(1));
  const double greater = std::max(furthest(0), furthest(1));
  const Eigen::Vector3d size = bounds.max - bounds.min;
  const double width = std::max(size.x(), size.y());
  return lesser <= kHighest && greater <= kLongest && width > 0 && width < kWidest &&
         size.z() > kSlimmest * width;
}

std::string DescribeDegrees(const Box& bounds) {
  return fmt::format("x from {:.8g} to {:.8g}, y from {:.8g} to {:.8g}, {:.3g} high",
                     bounds.min.x(),
                     bounds.max.x(),
                     bounds.min.y(),
                     bounds.max.y(),
                     bounds.max.z() - bounds.min.z());
}

}  // namespace groundglass
