// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/split_prior.h"
#include "register/ties/tie_points.h"

#include <ceres/sized_cost_function.h>

namespace groundglass {

// Where a tie point may be, world frame: point(m) = at + axes * m. The third axis is the face's
// normal; units are one sigma of the model. A surveyed point's axes are the world's, in units of
// its survey_sigma.
struct TieFrame {
  Eigen::Vector3d at_in_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes_in_world = Eigen::Matrix3d::Identity();

  Eigen::Vector3d PointInWorld(const Eigen::Vector3d& move) const {
    return at_in_world + axes_in_world * move;
  }
};
TieFrame FrameOfTiePoint(const TiePoint& point, double model_sigma);

// A tie point as one photograph shows it.
// Blocks: 11 whitened camera parameters, the lens' three (SplitPrior), the point's move in
// TieFrame. Two residuals, whitened by the observation's root_precision.
class TiePointCost
    : public ceres::SizedCostFunction<2, kNumCameraParameters, kNumLensParameters, 3> {
 public:
  TiePointCost(const TieObservation& observation, const SplitPrior& prior, const TieFrame& frame)
      : observation_(observation), prior_(prior), frame_(frame) {}
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override;

 private:
  TieObservation observation_;
  const SplitPrior& prior_;
  TieFrame frame_;
};

// How far a tie point lies from its face, as a residual: the third of its moves, in `sigmas` of the
// model. One block of 3, one residual.
class ReliefPriorCost : public ceres::SizedCostFunction<1, 3> {
 public:
  explicit ReliefPriorCost(double sigmas) : sigmas_(sigmas) {}
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override;

 private:
  double sigmas_;
};

}  // namespace groundglass
