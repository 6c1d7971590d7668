// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/surveyed_tags_in_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace groundglass {

void AddTagCorners(const std::vector<SeenTagCorner>& tag_corners,
                   const std::vector<PhotographInSet>& photographs,
                   const JointOptions& options,
                   std::vector<TiePoint>& ties) {
  std::map<std::pair<int, int>, TiePoint> tie_of_corner;
  for (const SeenTagCorner& corner : tag_corners) {
    const auto at =
        std::find_if(photographs.begin(), photographs.end(), [&](const PhotographInSet& other) {
          return other.name == corner.photograph;
        });
    if (at == photographs.end()) continue;
    TiePoint& tie = tie_of_corner[{corner.april_tag, corner.corner}];
    tie.point_in_world = corner.surveyed_in_world;
    tie.april_tag = corner.april_tag;
    tie.survey_sigma = options.shared_survey_factor * corner.survey_sigma;
    const double sigma_px = at->scale * std::max(corner.sigma_px, options.least_corner_px);
    tie.observations.push_back({static_cast<int>(at - photographs.begin()),
                                at->scale * corner.image_px,
                                Eigen::Matrix2d::Identity() / sigma_px});
  }
  for (auto& [corner, tie] : tie_of_corner) ties.push_back(std::move(tie));
}

std::vector<MovedTag> FindMovedTags(const std::vector<TiePoint>& ties,
                                    const std::vector<Eigen::Vector3d>& moves_in_world,
                                    const std::vector<PhotographInSet>& photographs,
                                    const JointOptions& options) {
  struct Moves {
    MovedTag tag;
    int num_corners = 0;
    std::set<int> seen_by;
  };
  std::map<int, Moves> moves_of_tag;
  for (size_t i = 0; i < std::min(ties.size(), moves_in_world.size()); ++i) {
    if (ties[i].april_tag < 0) continue;
    Moves& moves = moves_of_tag[ties[i].april_tag];
    moves.tag.april_tag = ties[i].april_tag;
    moves.tag.survey_sigma = ties[i].survey_sigma / options.shared_survey_factor;
    moves.tag.move_in_world += moves_in_world[i];
    ++moves.num_corners;
    for (const TieObservation& seen : ties[i].observations) moves.seen_by.insert(seen.photograph);
  }
  std::vector<MovedTag> moved;
  for (auto& [id, moves] : moves_of_tag) {
    moves.tag.move_in_world /= moves.num_corners;
    if (moves.tag.move_in_world.norm() <= options.moved_tag_sigmas * moves.tag.survey_sigma) {
      continue;
    }
    for (const int photograph : moves.seen_by) {
      moves.tag.photographs.push_back(photographs[static_cast<size_t>(photograph)].name);
    }
    moved.push_back(std::move(moves.tag));
  }
  return moved;
}

std::string DescribeMovedTag(const MovedTag& tag, const std::string& unit) {
  return fmt::format(
      "AprilTag {} hangs {:.2g} {} from where apriltags.csv has it (sigma {:.2g}), as {} show{} "
      "it: measure it again, or take its line out and run `groundglass calibrate tags` once more",
      tag.april_tag,
      tag.move_in_world.norm(),
      unit,
      tag.survey_sigma,
      fmt::join(tag.photographs, ", "),
      tag.photographs.size() == 1 ? "s" : "");
}

}  // namespace groundglass
