// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/least_norm.h"

namespace groundglass {

Eigen::MatrixXd SolveLeastNorm(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
  return matrix.completeOrthogonalDecomposition().solve(right);
}

}  // namespace groundglass
