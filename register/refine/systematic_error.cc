// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/systematic_error.h"

#include "register/edges/edge_whitening.h"

#include <cmath>

namespace groundglass {

Eigen::Matrix<double, Eigen::Dynamic, kNumSystematicModes> WhitenedSystematicModes(
    std::span<const AlignedSample> samples, int width_px, int height_px) {
  Eigen::Matrix<double, Eigen::Dynamic, kNumSystematicModes> pushes(
      static_cast<Eigen::Index>(samples.size()), kNumSystematicModes);
  pushes.setZero();
  for (size_t i = 0; i < samples.size(); ++i) {
    const AlignedSample& sample = samples[i];
    const double along_axis = sample.is_upright ? sample.normal.x() : sample.normal.y();
    const double right = sample.origin_px.x() - width_px / 2.0;
    const double down = sample.origin_px.y() - height_px / 2.0;
    const double outwards = sample.is_upright ? right : down;
    const double sideways = sample.is_upright ? -down : right;
    const double push =
        -std::sqrt(sample.precision) * std::copysign(sample.shared_bias_px, along_axis);
    const Eigen::Index first = sample.is_upright ? 0 : 3;
    pushes(static_cast<Eigen::Index>(i), first) = push;
    pushes(static_cast<Eigen::Index>(i), first + 1) = std::copysign(push, push * outwards);
    pushes(static_cast<Eigen::Index>(i), first + 2) = std::copysign(push, push * sideways);
  }
  EdgeWhitening(samples).Apply(pushes);
  return pushes;
}

CameraCovariance SystematicCovariance(const std::vector<AlignedSample>& samples,
                                      const CameraPrior& prior,
                                      const CameraParameters& whitened,
                                      const CameraCovariance& covariance) {
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, kNumCameraParameters, Eigen::RowMajor>;
  const auto count = static_cast<Eigen::Index>(samples.size());
  const double* block = whitened.data();
  Eigen::VectorXd residuals(count);
  Jacobian jacobian(count, kNumCameraParameters);
  double* jacobians[] = {jacobian.data()};
  if (!EdgeAlignmentCost(samples, prior).Evaluate(&block, residuals.data(), jacobians)) {
    return CameraCovariance::Zero();
  }
  Eigen::Matrix<double, Eigen::Dynamic, kNumSystematicModes> pushes(count, kNumSystematicModes);
  for (size_t start = 0; start < samples.size();) {
    size_t end = start;
    while (end < samples.size() && samples[end].edge == samples[start].edge) ++end;
    pushes.middleRows(static_cast<Eigen::Index>(start), static_cast<Eigen::Index>(end - start)) =
        WhitenedSystematicModes({&samples[start], end - start}, prior.width_px, prior.height_px);
    start = end;
  }
  // One Gauss-Newton step each: how far the solution follows.
  const Eigen::Matrix<double, kNumCameraParameters, kNumSystematicModes> moved =
      covariance * (jacobian.transpose() * pushes);
  return moved * moved.transpose();
}

}  // namespace groundglass
