// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/camera/control_points.h"

#include <ceres/cost_function.h>

#include <vector>

namespace groundglass {

// Where a person has pointed, against where the camera sees the model's point:
//   r_i = (project(point_i; mean + root u) - image_i) / sigma_i
// Block: u, 11 whitened parameters. Residuals: two for each point, without unit. A point behind
// the camera fails the evaluation. Points, prior: must outlive the cost; image_i in pixels of the
// prior's picture.
class ControlPointCost : public ceres::CostFunction {
 public:
  ControlPointCost(const std::vector<ControlPoint>& points, const CameraPrior& prior);
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override;

 private:
  const std::vector<ControlPoint>& points_;
  const CameraPrior& prior_;
};

}  // namespace groundglass
