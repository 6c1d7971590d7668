// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Core>

namespace groundglass {

// What must be added to a covariance because measured errors are larger than it counts on: the part
// of `measured - counted` that widens, in units of `covariance`. Where measured errors are smaller
// than counted on, as they are by chance in some direction, nothing is taken away. All are of the
// same parameters; counted: what of the covariance the measured errors' source accounts for.
Eigen::MatrixXd CovarianceExcess(const Eigen::MatrixXd& measured,
                                 const Eigen::MatrixXd& counted,
                                 const Eigen::MatrixXd& covariance);

}  // namespace groundglass
