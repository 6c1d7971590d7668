// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

namespace groundglass {

// A symmetric matrix as vectors * diag(values) * vectors^T, values in increasing order.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  // one in each column, unit length
};

// Eigen's solver, compiled once: each size of its own takes the compiler as long as a whole file.
SymmetricEigen DecomposeSymmetric(const Eigen::MatrixXd& matrix);

}  // namespace groundglass
