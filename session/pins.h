// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

enum class PinUse {
  kUsed,
  kCheck,  // measured, but has no say
  kOff,
};

// A point of the model and where a person sees it in the photograph.
struct PointPin {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
  double sigma_px = 2;  // one standard deviation each way, of pointing and of the model together
  PinUse use = PinUse::kUsed;

  bool operator==(const PointPin&) const = default;
};

// A stretch of one of the model's edges and a line of the photograph that it lies on; where along
// the line is left open.
struct LinePin {
  Eigen::Vector3d start_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector2d first_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d second_px = Eigen::Vector2d::Zero();
  double sigma_px = 2;  // across the line
  PinUse use = PinUse::kUsed;

  bool operator==(const LinePin&) const = default;
};

struct Pins {
  std::vector<PointPin> points;
  std::vector<LinePin> lines;

  bool operator==(const Pins&) const = default;
};

}  // namespace groundglass
