// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/split_prior.h"
#include "register/edges/aligned_sample.h"
#include "register/edges/edge_samples.h"
#include "register/joint/aligned_photograph.h"
#include "register/joint/joint_options.h"
#include "register/joint/shared_edge_cost.h"
#include "register/joint/tie_point_cost.h"

#include <Eigen/Dense>

#include <memory_resource>
#include <vector>

namespace groundglass {

// A model edge as the solve moves it.
struct MovingEdge {
  EdgeFrame frame;
  Eigen::Vector4d displacement = Eigen::Vector4d::Zero();  // in units of the frame's scale
  int num_photographs = 0;                                 // that matched it in the last round
};

// A group of edges as the solve moves it.
struct MovingGroup {
  Eigen::Vector2d move = Eigen::Vector2d::Zero();  // in units of its scale; the first num_numbers
  int num_numbers = 1;
};

// A tie point as the solve moves it.
struct MovingTie {
  TieFrame frame;
  Eigen::Vector3d move = Eigen::Vector3d::Zero();  // in the frame's units
};

// A photograph as the solve moves it.
struct MovingPhotograph {
  SplitPrior prior;
  CameraParameters own = CameraParameters::Zero();
  int lens = 0;
  double noise_px = 0;
  int num_matched = 0;
};

// One run of samples of one edge in one photograph, matched.
struct MatchedRun {
  size_t photograph = 0;
  int edge = -1;
  std::vector<AlignedSample> samples;
};

// All that the joint solve moves, and what was matched last. Ceres knows its arrays by their
// addresses: it stays where it is once a problem has been made of it.
struct JointState {
  JointState(const EdgeModel& edge_model_,
             const std::vector<AlignedPhotograph>& photographs_,
             const std::vector<int>& lens_of_photograph,
             const std::vector<TiePoint>& tie_points_,
             const JointOptions& options);

  // What moves an edge: its own displacement, or the ground's.
  const MovingEdge& MoverOf(int edge) const {
    return edge_model.tolerances[edge].on_ground ? ground : edges[edge];
  }
  MovingEdge& MoverOf(int edge) {
    return edge_model.tolerances[edge].on_ground ? ground : edges[edge];
  }
  // How far the solve has moved an edge with its groups.
  Eigen::Vector3d GroupMoveOf(int edge) const;
  // And a point of it in all: with its groups and by itself.
  Eigen::Vector3d DisplacementOf(int edge, double along) const;
  ParameterProjection ProjectionOf(const MovingPhotograph& photograph) const {
    return photograph.prior.ProjectionAt(photograph.own, lenses[photograph.lens]);
  }

  const EdgeModel& edge_model;
  const std::vector<AlignedPhotograph>& photographs;
  const std::vector<TiePoint>& tie_points;
  // Holds edges and ties one behind the other: Ceres orders what it eliminates by addresses, and
  // the order, with it the rounding, is to be the same in every run.
  std::pmr::monotonic_buffer_resource arena;
  EdgeBias own_bias;                     // of an edge in one photograph, its size as found so far
  std::vector<MovingPhotograph> moving;  // for each photograph
  std::vector<LensParameters> lenses;
  std::pmr::vector<MovingEdge> edges;  // for each of EdgeModel::edges
  std::pmr::vector<MovingTie> ties;    // for each of tie_points
  MovingEdge ground;
  double group_offset_sigmas = 1;   // the scale of a group's numbers, as found so far
  std::vector<MovingGroup> groups;  // of EdgeModel::groups
  std::vector<std::vector<EdgeGroupPart>> groups_of_edge;  // those that are moved, in their scale
  std::vector<MatchedRun> runs;
};

}  // namespace groundglass
