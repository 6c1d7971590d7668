// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera_prior.h"
#include "register/edge_samples.h"

#include <ceres/cost_function.h>

#include <vector>

namespace groundglass {

// One edge sample with what the photograph says of it.
struct AlignedSample {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  int edge = -1;
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();  // where offset 0 lies
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double offset_px = 0;  // where the photograph's edge lies, from origin along normal
  double precision = 0;  // 1 / variance of offset_px, 1 / px^2; 0 for an outlier
  // The model edge's own error here: one sigma of its shift as a whole, and of its turn (signed).
  Eigen::Vector2d bias_px = Eigen::Vector2d::Zero();
  // One sigma of the error that it shares with all edges that run its way (SharedBiasCovariance).
  double shared_bias_px = 0;
  bool is_upright = false;
};

// Distances between projected model edges and the photograph's edges, for all samples of one
// photograph:
//   r_i = sqrt(precision_i) (normal_i . (project(point_i; mean + root u) - origin_i) - offset_i)
// Each model edge has an error of its own (windows are recessed, eaves overhang, plans are
// rounded): a shift and a turn, with prior sigmas bias_i, integrated out. Samples of one edge have
// covariance I + A A^T with rows A_i = sqrt(precision_i) bias_i^T, and the residuals are whitened
// by its inverse square root. Samples must come sorted by edge. Block: u, 11 whitened parameters.
// Residuals: one per sample, without unit.
class EdgeAlignmentCost : public ceres::CostFunction {
 public:
  EdgeAlignmentCost(const std::vector<AlignedSample>& samples,
                    const CameraPrior& prior,
                    double k2,
                    int width_px,
                    int height_px);
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override;

 private:
  const std::vector<AlignedSample>& samples_;
  const CameraPrior& prior_;
  double k2_;
  int width_px_;
  int height_px_;
};

}  // namespace groundglass
