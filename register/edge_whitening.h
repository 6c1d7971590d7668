// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/aligned_sample.h"

#include <Eigen/Dense>

#include <cmath>
#include <span>

namespace groundglass {

// Integrates out a model edge's own error (AlignedSample::bias_px) from the residuals of its
// samples. These, in units of their noise, have covariance I + A A^T with rows
// A_i = sqrt(precision_i) bias_i^T; rows are whitened by its inverse square root, which is
// I - A G A^T: G shares its eigenvectors with A^T A and has eigenvalues
// (1 - 1 / sqrt(1 + l)) / l.
class EdgeWhitening {
 public:
  explicit EdgeWhitening(std::span<const AlignedSample> samples) : a_(samples.size(), 2) {
    for (size_t i = 0; i < samples.size(); ++i) {
      a_.row(static_cast<Eigen::Index>(i)) =
          std::sqrt(samples[i].precision) * samples[i].bias_px.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(a_.transpose() * a_);
    Eigen::Vector2d shrink = Eigen::Vector2d::Zero();
    for (int k = 0; k < 2; ++k) {
      const double l = eigen.eigenvalues()[k];
      if (l > 1e-12) shrink[k] = (1 - 1 / std::sqrt(1 + l)) / l;
    }
    g_ = eigen.eigenvectors() * shrink.asDiagonal() * eigen.eigenvectors().transpose();
  }

  // One row for each sample: residuals, or their derivatives.
  template <typename Derived>
  void Apply(Eigen::MatrixBase<Derived>&& rows) const {
    const Eigen::Matrix<double, 2, Derived::ColsAtCompileTime> inner = g_ * (a_.transpose() * rows);
    rows.derived().noalias() -= a_ * inner;
  }
  template <typename Derived>
  void Apply(Eigen::MatrixBase<Derived>& rows) const {
    Apply(std::move(rows));
  }

 private:
  Eigen::Matrix<double, Eigen::Dynamic, 2> a_;
  Eigen::Matrix2d g_;
};

}  // namespace groundglass
