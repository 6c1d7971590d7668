// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/edges/edge_residuals.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// How far a model edge was found from where the model has it.
struct EdgeDisplacement {
  int edge = -1;  // in EdgeModel::edges
  // Of the edge's two ends, across it, model's unit.
  Eigen::Vector3d start_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_in_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of the edge's middle
  std::vector<int> photographs;                          // that show it, by their places
};

struct JointSolution {
  CameraParameters whitened = CameraParameters::Zero();
  CameraCovariance covariance = CameraCovariance::Identity();  // of the whitened parameters
  int num_matched = 0;
  // Of the matched samples from the model's edges as the model has them.
  std::vector<SampleResidual> residuals = {};
};

struct JointRefinement {
  std::vector<JointSolution> photographs;       // in the order given
  std::vector<EdgeDisplacement> displacements;  // in order of edge
  // Of each of the model's edges, how far its groups lie off (EdgeGroups), model's unit.
  std::vector<Eigen::Vector3d> group_moves_in_world = {};
  // Of each tie point, from where it was given; model's unit.
  std::vector<Eigen::Vector3d> tie_moves_in_world = {};
};

}  // namespace groundglass
