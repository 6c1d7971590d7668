// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

#include <optional>

namespace groundglass {

// Of symmetric, positive definite matrices. Eigen's Cholesky factors, compiled once: each size of
// its own takes the compiler as long as a whole file.

// None where the matrix is not positive definite.
std::optional<Eigen::MatrixXd> InvertByCholesky(const Eigen::MatrixXd& matrix);

// The upper triangle U of matrix = U^T U: of an information matrix, what whitens its residuals.
// None where the matrix is not positive definite.
std::optional<Eigen::MatrixXd> UpperCholeskyFactor(const Eigen::MatrixXd& matrix);

}  // namespace groundglass
