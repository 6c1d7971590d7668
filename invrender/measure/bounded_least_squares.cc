// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/measure/bounded_least_squares.h"

#include <algorithm>

namespace groundglass {

Eigen::VectorXd SolveBounded(const Eigen::MatrixXd& normal,
                             const Eigen::VectorXd& right,
                             double least) {
  constexpr int kRounds = 200;
  Eigen::VectorXd x = Eigen::VectorXd::Constant(right.size(), least);
  for (int round = 0; round < kRounds; ++round) {
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double rest = right[i] - normal.col(i).dot(x);
      x[i] = std::max(least, x[i] + rest / normal(i, i));
    }
  }
  return x;
}

}  // namespace groundglass
