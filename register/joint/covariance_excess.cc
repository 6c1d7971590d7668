// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/covariance_excess.h"

#include "scene/least_norm.h"
#include "scene/symmetric_eigen.h"

namespace groundglass {

Eigen::MatrixXd CovarianceExcess(const Eigen::MatrixXd& measured,
                                 const Eigen::MatrixXd& counted,
                                 const Eigen::MatrixXd& covariance) {
  const SymmetricEigen own = DecomposeSymmetric(covariance);
  const Eigen::MatrixXd root = own.vectors * own.values.cwiseMax(0).cwiseSqrt().asDiagonal();
  const Eigen::MatrixXd difference = measured - counted;
  // R^-1 D R^-T with R R^T the covariance, which is the identity there. What has no variance gets
  // none.
  const Eigen::MatrixXd half = SolveLeastNorm(root, difference);
  const Eigen::MatrixXd relative = SolveLeastNorm(root, half.transpose());
  const SymmetricEigen axes = DecomposeSymmetric(0.5 * (relative + relative.transpose()));
  const Eigen::MatrixXd widened =
      root * axes.vectors * axes.values.cwiseMax(0).cwiseSqrt().asDiagonal();
  return widened * widened.transpose();
}

}  // namespace groundglass
