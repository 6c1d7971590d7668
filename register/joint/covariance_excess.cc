// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/covariance_excess.h"

#include "scene/cholesky.h"
#include "scene/least_norm.h"
#include "scene/symmetric_eigen.h"

namespace groundglass {

Eigen::MatrixXd CovarianceExcess(const Eigen::MatrixXd& measured,
                                 const Eigen::MatrixXd& counted,
                                 const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd root = UpperCholeskyFactor(covariance).transpose();
  const Eigen::MatrixXd difference = measured - counted;
  // L^-1 D L^-T, in which the covariance is the identity.
  const Eigen::MatrixXd half = SolveLeastNorm(root, difference);
  const Eigen::MatrixXd relative = SolveLeastNorm(root, half.transpose());
  const SymmetricEigen axes = DecomposeSymmetric(0.5 * (relative + relative.transpose()));
  const Eigen::MatrixXd widened =
      root * axes.vectors * axes.values.cwiseMax(0).cwiseSqrt().asDiagonal();
  return widened * widened.transpose();
}

}  // namespace groundglass
