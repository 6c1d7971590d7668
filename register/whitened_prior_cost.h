// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/registration.h"

#include <ceres/sized_cost_function.h>

#include <algorithm>

namespace groundglass {

// The prior as residuals: whitened parameters are standard normal, so they are their own residuals,
// without unit. Block: the 11 whitened parameters. (Ceres' NormalPrior would do, but it frees here
// what the library allocated, and a sanitizer build aligns memory differently.)
class WhitenedPriorCost
    : public ceres::SizedCostFunction<kNumCameraParameters, kNumCameraParameters> {
 public:
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    std::copy_n(parameters[0], kNumCameraParameters, residuals);
    if (jacobians && jacobians[0]) {
      Eigen::Map<CameraCovariance> by_whitened(jacobians[0]);
      by_whitened.setIdentity();
    }
    return true;
  }
};

}  // namespace groundglass
