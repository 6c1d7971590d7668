// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

namespace groundglass {

// The x of least squares |matrix x - right|, and of those the one of least norm, where the matrix
// has not full rank. matrix: m x n; right: m x k; gives n x k. Eigen's complete orthogonal
// decomposition, compiled once: each size of its own takes the compiler as long as a whole file.
Eigen::MatrixXd SolveLeastNorm(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

}  // namespace groundglass
