// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/joint/joint_options.h"
#include "register/ties/tie_points.h"
#include "scene/formats/tag_corners.h"

#include <string>
#include <vector>

namespace groundglass {

// A photograph among those that are refined together.
struct PhotographInSet {
  std::string name;
  double scale = 1;  // pixels of the picture that is refined for one of the photograph's
};

// An AprilTag that photographs put elsewhere than its survey.
struct MovedTag {
  int april_tag = -1;
  Eigen::Vector3d move_in_world = Eigen::Vector3d::Zero();  // from its surveyed place; model's unit
  double survey_sigma = 0;
  std::vector<std::string> photographs;  // that show it
};

// Adds surveyed AprilTags' corners in these photographs to the tie points: one point for each
// corner of each tag, seen by each photograph that shows it.
void AddTagCorners(const std::vector<SeenTagCorner>& tag_corners,
                   const std::vector<PhotographInSet>& photographs,
                   const JointOptions& options,
                   std::vector<TiePoint>& ties);

// The tags whose corners moved away from the survey in the mean; by id.
std::vector<MovedTag> FindMovedTags(const std::vector<TiePoint>& ties,
                                    const std::vector<Eigen::Vector3d>& moves_in_world,
                                    const std::vector<PhotographInSet>& photographs,
                                    const JointOptions& options);

// One line for a person.
std::string DescribeMovedTag(const MovedTag& tag, const std::string& unit);

}  // namespace groundglass
