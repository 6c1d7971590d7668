// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/symmetric_eigen.h"

namespace groundglass {

SymmetricEigen DecomposeSymmetric(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace groundglass
