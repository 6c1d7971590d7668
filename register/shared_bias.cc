// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/shared_bias.h"

#include <cmath>

namespace groundglass {

CameraCovariance SharedBiasCovariance(const std::vector<AlignedSample>& samples,
                                      const CameraPrior& prior,
                                      double k2,
                                      int width_px,
                                      int height_px,
                                      const CameraParameters& whitened,
                                      const CameraCovariance& covariance) {
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, kNumCameraParameters, Eigen::RowMajor>;
  const auto count = static_cast<Eigen::Index>(samples.size());
  const double* block = whitened.data();
  Eigen::VectorXd residuals(count);
  Jacobian jacobian(count, kNumCameraParameters);
  double* jacobians[] = {jacobian.data()};
  CameraCovariance added = CameraCovariance::Zero();
  if (!EdgeAlignmentCost(samples, prior, k2, width_px, height_px)
           .Evaluate(&block, residuals.data(), jacobians)) {
    return added;
  }
  for (const bool upright : {true, false}) {
    for (const bool spreading : {false, true}) {
      std::vector<AlignedSample> pushed = samples;
      for (AlignedSample& sample : pushed) {
        if (sample.is_upright != upright) continue;
        const double along_axis = upright ? sample.normal.x() : sample.normal.y();
        const double from_middle = upright ? sample.origin_px.x() - width_px / 2.0
                                           : sample.origin_px.y() - height_px / 2.0;
        double push_px = std::copysign(sample.shared_bias_px, along_axis);
        if (spreading) push_px = std::copysign(push_px, push_px * from_middle);
        sample.offset_px += push_px;
      }
      Eigen::VectorXd pushed_residuals(count);
      EdgeAlignmentCost(pushed, prior, k2, width_px, height_px)
          .Evaluate(&block, pushed_residuals.data(), nullptr);
      // One Gauss-Newton step: how far the solution follows.
      const CameraParameters moved =
          covariance * (jacobian.transpose() * (pushed_residuals - residuals));
      added += moved * moved.transpose();
    }
  }
  return added;
}

}  // namespace groundglass
