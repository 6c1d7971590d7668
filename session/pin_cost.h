// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to session.
#pragma once

#include "register/register.h"
#include "session/pins.h"

#include <ceres/cost_function.h>

namespace groundglass {

// Where pins are, against where the camera sees what they hold:
//   point:  r = (project(point; mean + root u) - image) / sigma             two residuals
//   line:   r = the distances of its two image points from the line through project(start) and
//           project(end), / sigma                                           two residuals
// Block: u, 11 whitened parameters of the prior. A point behind the camera fails the evaluation.
// pins and prior must outlive the cost. Pins that are not kUsed are left out.
class PinCost : public ceres::CostFunction {
 public:
  PinCost(const Pins& pins, const CameraPrior& prior);
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override;

 private:
  std::vector<PointPin> points_;
  std::vector<LinePin> lines_;
  const CameraPrior& prior_;
};

// The signed distances, px, of a line pin's two image points from the image of its stretch of edge,
// with their derivatives by the camera's parameters; nothing if an end is behind the camera.
struct LineDistances {
  Eigen::Vector2d distances_px;
  Eigen::Matrix<double, 2, kNumCameraParameters> jacobian;
};
std::optional<LineDistances> MeasureLine(const LinePin& pin, const ParameterProjection& projection);

}  // namespace groundglass
