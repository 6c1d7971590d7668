// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/split_prior.h"
#include "register/edges/aligned_sample.h"
#include "register/edges/edge_groups.h"

#include <ceres/sized_cost_function.h>

#include <vector>

namespace groundglass {

// The two directions across a model edge, in units of one sigma of its displacement, world frame.
// Displacement of a point at `along`: across * (d.head<2>() + along * turn_ratio * d.tail<2>()).
struct EdgeFrame {
  Eigen::Matrix<double, 3, 2> across = Eigen::Matrix<double, 3, 2>::Zero();
  double turn_ratio = 1;

  Eigen::Vector3d Displacement(const Eigen::Vector4d& d, double along) const {
    return across * (d.head<2>() + along * turn_ratio * d.tail<2>());
  }
};

// EdgeAlignmentCost for one model edge in one photograph, the edge itself displaced.
// Blocks: 11 whitened camera parameters, the lens' (SplitPrior), the edge's displacement in units
// of its scale, and the numbers of each of its groups, in units of theirs. Residuals: one per
// sample, without unit, whitened.
class SharedEdgeCost : public ceres::CostFunction {
 public:
  SharedEdgeCost(std::vector<AlignedSample> samples,
                 const SplitPrior& prior,
                 const EdgeFrame& frame,
                 std::vector<EdgeGroupPart> groups = {});
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override;

 private:
  std::vector<AlignedSample> samples_;
  const SplitPrior& prior_;
  EdgeFrame frame_;
  std::vector<EdgeGroupPart> groups_;
};

}  // namespace groundglass
