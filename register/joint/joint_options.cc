// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/joint_options.h"

#include "scene/check_option.h"

namespace groundglass {

void JointOptions::Check(const std::string& path) const {
  CheckAbove(common_offset_sigmas, 0, path + "common_offset_sigmas");
  CheckAbove(common_turn_sigmas, 0, path + "common_turn_sigmas");
  CheckAbove(group_offset_sigmas, 0, path + "group_offset_sigmas");
  CheckAbove(usual_group_quartile_sigmas, 0, path + "usual_group_quartile_sigmas");
  CheckFromTo(least_groups, 1, 1000000, path + "least_groups");
  CheckFromTo(
      least_group_offset_sigmas, 1e-6, group_offset_sigmas, path + "least_group_offset_sigmas");
  CheckFromTo(least_edges_of_group, 1, 1000000, path + "least_edges_of_group");
  CheckFromTo(most_groups, 0, 1000000, path + "most_groups");
  CheckAbove(widest_offset_sigmas, 0, path + "widest_offset_sigmas");
  CheckAbove(ground_level_sigmas, 0, path + "ground_level_sigmas");
  own.Check(path + "own.");
  CheckAbove(own_degrees_of_freedom, 0, path + "own_degrees_of_freedom");
  CheckAbove(least_own_offset_sigmas, 0, path + "least_own_offset_sigmas");
  CheckAtLeast(most_own_offset_sigmas, least_own_offset_sigmas, path + "most_own_offset_sigmas");
  CheckAbove(least_shared_offset_sigmas, 0, path + "least_shared_offset_sigmas");
  CheckAtLeast(
      most_shared_offset_sigmas, least_shared_offset_sigmas, path + "most_shared_offset_sigmas");
  CheckFromTo(own_k1_share, 1e-9, 1, path + "own_k1_share");
  CheckFromTo(own_view_angle_share, 1e-9, 1, path + "own_view_angle_share");
  CheckFromTo(own_aspect_share, 1e-9, 1, path + "own_aspect_share");
  CheckFromTo(own_shift_share, 1e-9, 1, path + "own_shift_share");
  CheckAbove(tie_loss_sigmas, 0, path + "tie_loss_sigmas");
  CheckAbove(relief_sigmas, 0, path + "relief_sigmas");
  CheckAbove(widest_relief_sigmas, 0, path + "widest_relief_sigmas");
  CheckAbove(survey_loss_sigmas, 0, path + "survey_loss_sigmas");
  CheckAbove(least_corner_px, 0, path + "least_corner_px");
  CheckAtLeast(shared_survey_factor, 1, path + "shared_survey_factor");
  CheckAbove(moved_tag_sigmas, 0, path + "moved_tag_sigmas");
  CheckFromTo(num_rounds, 1, 1000, path + "num_rounds");
  matching.Check(path + "matching.");
  CheckAtLeast(spare_range, 1, path + "spare_range");
  CheckAtLeast(start_range_px, matching.final_range_px, path + "start_range_px");
  CheckFromTo(shrink, 0.01, 0.99, path + "shrink");
  CheckFromTo(min_noise_px, 1e-6, matching.final_range_px / 2, path + "min_noise_px");
}

}  // namespace groundglass
