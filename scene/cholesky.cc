// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/cholesky.h"

namespace groundglass {

std::optional<Eigen::MatrixXd> InvertByCholesky(const Eigen::MatrixXd& matrix) {
  const Eigen::LLT<Eigen::MatrixXd> factors(matrix);
  if (factors.info() != Eigen::Success) return std::nullopt;
  return factors.solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

std::optional<Eigen::MatrixXd> UpperCholeskyFactor(const Eigen::MatrixXd& matrix) {
  const Eigen::LLT<Eigen::MatrixXd> factors(matrix);
  if (factors.info() != Eigen::Success) return std::nullopt;
  return factors.matrixU();
}

}  // namespace groundglass
