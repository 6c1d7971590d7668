// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/feature_edges.h"
#include "scene/polygon_model.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// What is measured once errs as one: all walls along a line of the plan, eaves and floors at one
// level, the windows that are drawn onto a wall. Such edges are a group, and a group is displaced
// by one number (a plane along its normal) or two (what is drawn onto a plane, within it).
struct EdgeGroupPart {
  int group = -1;
  // What one unit of each of the group's numbers does to the edge, world frame.
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 2> directions;
};

struct EdgeGroups {
  std::vector<int> num_numbers;                     // of each group: 1 or 2
  std::vector<std::vector<EdgeGroupPart>> of_edge;  // for each of the model's edges
};

// The groups that each edge belongs to: the planes of its faces, where it is the border of one face
// also the plane across that face (walls without a roof still end at one level), and the drawing on
// its plane if both its faces lie in it. An edge on the ground has no level of its own.
// tolerance: how far planes may lie apart and still be one, in the model's unit; on_ground: for
// each edge.
EdgeGroups FindEdgeGroups(const PolygonModel& model,
                          const std::vector<ModelEdge>& edges,
                          const std::vector<bool>& on_ground,
                          double tolerance);

}  // namespace groundglass
