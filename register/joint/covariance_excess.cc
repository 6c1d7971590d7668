// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/covariance_excess.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace groundglass {

Eigen::MatrixXd CovarianceExcess(const Eigen::MatrixXd& measured,
                                 const Eigen::MatrixXd& counted,
                                 const Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  const Eigen::MatrixXd difference = measured - counted;
  // L^-1 D L^-T, in which the covariance is the identity.
  const Eigen::MatrixXd half = root.matrixL().solve(difference);
  const Eigen::MatrixXd relative = root.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(0.5 *
                                                            (relative + relative.transpose()));
  const Eigen::MatrixXd widened = root.matrixL() * axes.eigenvectors() *
                                  axes.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  return widened * widened.transpose();
}

}  // namespace groundglass
