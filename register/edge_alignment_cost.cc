// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edge_alignment_cost.h"

#include "register/parameter_projection.h"

#include <cmath>

namespace groundglass {

EdgeAlignmentCost::EdgeAlignmentCost(const std::vector<AlignedSample>& samples,
                                     const CameraPrior& prior,
                                     double k2,
                                     int width_px,
                                     int height_px)
    : samples_(samples), prior_(prior), k2_(k2), width_px_(width_px), height_px_(height_px) {
  set_num_residuals(static_cast<int>(samples.size()));
  mutable_parameter_block_sizes()->push_back(kNumCameraParameters);
}

bool EdgeAlignmentCost::Evaluate(double const* const* parameters,
                                 double* residuals,
                                 double** jacobians) const {
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, kNumCameraParameters, Eigen::RowMajor>;
  const Eigen::Map<const CameraParameters> whitened(parameters[0]);
  const ParameterProjection projection(
      prior_.mean + prior_.root * whitened, k2_, width_px_, height_px_);
  const auto count = static_cast<Eigen::Index>(samples_.size());
  Eigen::Map<Eigen::VectorXd> r(residuals, count);
  const bool with_jacobian = jacobians && jacobians[0];
  Eigen::Map<Jacobian> by_whitened(
      with_jacobian ? jacobians[0] : nullptr, with_jacobian ? count : 0, kNumCameraParameters);
  for (Eigen::Index i = 0; i < count; ++i) {
    const AlignedSample& sample = samples_[i];
    const auto projected = projection.Project(sample.point_in_world);
    if (!projected) return false;
    const double weight = std::sqrt(sample.precision);
    r[i] = weight * (sample.normal.dot(projected->image_px - sample.origin_px) - sample.offset_px);
    if (with_jacobian) {
      by_whitened.row(i) = weight * (sample.normal.transpose() * projected->jacobian) * prior_.root;
    }
  }

  // Whiten each edge's run of samples: (I + A A^T)^(-1/2) = I - A G A^T, where G shares its
  // eigenvectors with A^T A and has eigenvalues (1 - 1 / sqrt(1 + l)) / l.
  for (Eigen::Index start = 0; start < count;) {
    Eigen::Index end = start;
    Eigen::Matrix2d squared = Eigen::Matrix2d::Zero();
    Eigen::Vector2d times_r = Eigen::Vector2d::Zero();
    Eigen::Matrix<double, 2, kNumCameraParameters> times_jacobian;
    times_jacobian.setZero();
    const auto a = [&](Eigen::Index i) -> Eigen::Vector2d {
      return std::sqrt(samples_[i].precision) * samples_[i].bias_px;
    };
    for (; end < count && samples_[end].edge == samples_[start].edge; ++end) {
      squared += a(end) * a(end).transpose();
      times_r += a(end) * r[end];
      if (with_jacobian) times_jacobian += a(end) * by_whitened.row(end);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(squared);
    Eigen::Vector2d shrink = Eigen::Vector2d::Zero();
    for (int k = 0; k < 2; ++k) {
      const double l = eigen.eigenvalues()[k];
      if (l > 1e-12) shrink[k] = (1 - 1 / std::sqrt(1 + l)) / l;
    }
    const Eigen::Matrix2d g =
        eigen.eigenvectors() * shrink.asDiagonal() * eigen.eigenvectors().transpose();
    const Eigen::Vector2d g_times_r = g * times_r;
    const Eigen::Matrix<double, 2, kNumCameraParameters> g_times_jacobian = g * times_jacobian;
    for (Eigen::Index i = start; i < end; ++i) {
      r[i] -= a(i).dot(g_times_r);
      if (with_jacobian) by_whitened.row(i) -= a(i).transpose() * g_times_jacobian;
    }
    start = end;
  }
  return true;
}

}  // namespace groundglass
