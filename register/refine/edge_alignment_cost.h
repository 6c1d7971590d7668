// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/edges/aligned_sample.h"

#include <ceres/cost_function.h>

#include <vector>

namespace groundglass {

// Distances between projected model edges and the photograph's edges, for all samples of one
// photograph:
//   r_i = sqrt(precision_i) (normal_i . (project(point_i; mean + root u) - origin_i) - offset_i)
// whitened edge by edge (EdgeWhitening). Samples must come sorted by edge. Block: u, 11 whitened
// parameters. Residuals: one per sample, without unit.
class EdgeAlignmentCost : public ceres::CostFunction {
 public:
  EdgeAlignmentCost(const std::vector<AlignedSample>& samples, const CameraPrior& prior);
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override;

 private:
  const std::vector<AlignedSample>& samples_;
  const CameraPrior& prior_;
};

}  // namespace groundglass
