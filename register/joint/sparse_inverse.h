// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>

#include <optional>

namespace groundglass {

// The inverse of a symmetric positive definite matrix (n x n) that is sparse, as its inverse is
// not; nothing if it has none. Each thread takes some columns at a time; the result does not depend
// on their number.
std::optional<Eigen::MatrixXd> InverseOfSparse(const Eigen::SparseMatrix<double>& matrix);

}  // namespace groundglass
