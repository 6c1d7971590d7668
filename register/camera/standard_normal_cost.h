// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>
#include <ceres/sized_cost_function.h>

#include <algorithm>

namespace groundglass {

// A prior as residuals: whitened parameters are standard normal, so they are their own residuals,
// without unit. One block of Size. (Ceres' NormalPrior would do, but it frees here what the library
// allocated, and a sanitizer build aligns memory differently.)
template <int Size>
class StandardNormalCost : public ceres::SizedCostFunction<Size, Size> {
 public:
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    std::copy_n(parameters[0], Size, residuals);
    if (jacobians && jacobians[0]) {
      for (int i = 0; i < Size * Size; ++i) jacobians[0][i] = i % (Size + 1) == 0 ? 1 : 0;
    }
    return true;
  }
};

}  // namespace groundglass
