// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/feature_edges.h"
#include "scene/polygon_model.h"

#include <Eigen/Dense>

#include <optional>
#include <vector>

namespace groundglass {

// Planes that differ by less in direction are parallel.
inline constexpr double kParallelCosine = 0.9998;  // 1.1 degrees

// What is measured once errs as one: all walls along a line of the plan, eaves and floors at one
// level, the windows that are drawn onto a wall. Such edges are a group, and a group is displaced
// by one number (a plane along its normal) or two (what is drawn onto a plane, within it).
struct EdgeGroupPart {
  int group = -1;
  // What one unit of each of the group's numbers does to the edge, world frame.
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 2> directions;
};

// Groups that are off together where something was measured wrongly: what stands out of a wall or
// lies back in it, with the wall; what lies higher, with the eaves.
struct EdgeGroupSet {
  std::vector<int> groups;
  std::vector<double> factors;  // how far each group goes where the set goes by one
  int number = 0;               // which of the groups' numbers
  // Where upright planes of it go, unit length. Zero for others: those that lie so high or higher
  // go up, and what is drawn onto a plane goes within it.
  Eigen::Vector3d across_in_world = Eigen::Vector3d::Zero();
};

struct EdgeGroups {
  std::vector<int> num_numbers;                     // of each group: 1 or 2
  std::vector<EdgeGroupSet> sets;                   // of models with 2000 planes at the most
  std::vector<std::vector<EdgeGroupPart>> of_edge;  // for each of the model's edges
};

// The groups that each edge belongs to: the planes of its faces, where it is the border of one face
// also the plane across that face (walls without a roof still end at one level), and the drawing on
// its plane if both its faces lie in it. An edge on the ground has no level of its own.
// tolerance: how far planes may lie apart and still be one, and attached: parallel upright planes
// to be off together, in the model's unit; on_ground: for each edge.
EdgeGroups FindEdgeGroups(const PolygonModel& model,
                          const std::vector<ModelEdge>& edges,
                          const std::vector<bool>& on_ground,
                          double tolerance,
                          double attached);

// What one unit of a set's offset does to each of the model's edges, world frame; nothing to those
// that are not of it.
std::vector<std::optional<Eigen::Vector3d>> MovesOfSet(const EdgeGroupSet& set,
                                                       const EdgeGroups& groups);

}  // namespace groundglass
