// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/photograph_plan.h"
#include "datasets-synthetic/synthetic_world.h"

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace groundglass {

// An AprilTag (tag36h11) that hangs upright on a wall of the photographed building.
struct WallTag {
  int id = 0;
  Eigen::Vector3d middle_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_in_world = Eigen::Vector3d::Zero();    // the wall's, outwards
  Eigen::Vector3d surveyed_in_world = Eigen::Vector3d::Zero();  // the middle as it was measured
};

// Hangs the recipe's AprilTags where the photographs show them best: each in turn where it adds
// most to those that show the fewest so far. Fewer than asked for where no further wall is seen
// large enough. Throws Error if not one is.
std::vector<WallTag> HangWallTags(const SynthRecipe& recipe,
                                  const std::vector<PhotographPlan>& photographs,
                                  SyntheticWorld& world);

// apriltags.csv (docs/calibration.md), in `site`: as they were surveyed, or where they truly are.
std::string FormatWallTags(const std::vector<WallTag>& tags,
                           const SynthRecipe::AprilTags& recipe,
                           bool is_truth);

}  // namespace groundglass
