// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/random/massing.h"
#include "scene/frames.h"

namespace groundglass {

// Where the plan's frame lies in `world`: the middle of the first body at the origin, turned by the
// heading, counterclockwise seen from above.
struct PlanFrame {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();

  PlanFrame(const Body& main, double heading_deg)
      : middle((main.Low() + main.High()) / 2),
        turn(Eigen::Rotation2Dd(RadiansFromDegrees(heading_deg)).toRotationMatrix()) {}

  Eigen::Vector3d ToWorld(const Eigen::Vector3d& in_plan) const {
    const Eigen::Vector2d place = turn * (in_plan.head<2>() - middle);
    return {place.x(), place.y(), in_plan.z()};
  }
};

}  // namespace groundglass
