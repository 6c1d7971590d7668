// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

namespace groundglass {

// The x of least squares (normal x = right) that is nowhere below `least`, by projected
// Gauss-Seidel (Cryer 1971). The matrix must be positive definite.
Eigen::VectorXd SolveBounded(const Eigen::MatrixXd& normal,
                             const Eigen::VectorXd& right,
                             double least);

}  // namespace groundglass
