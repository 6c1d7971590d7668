// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/edges/aligned_sample.h"

#include <Eigen/Dense>

#include <span>
#include <vector>

namespace groundglass {

// Integrates out a model edge's own error (AlignedSample::bias_px) from the residuals of its
// samples. These, in units of their noise, have covariance I + A A^T with rows
// A_i = sqrt(precision_i) bias_i^T; rows are whitened by its inverse square root, which is
// I - A G A^T: G shares its eigenvectors with A^T A and has eigenvalues
// (1 - 1 / sqrt(1 + l)) / l.
class EdgeWhitening {
 public:
  explicit EdgeWhitening(std::span<const AlignedSample> samples);

  // One row for each sample: residuals, or their derivatives; a matrix or a part of one.
  template <typename Derived>
  void Apply(Eigen::MatrixBase<Derived>&& rows) const {
    Derived& at = rows.derived();
    ApplyTo({at.data(), at.rows(), at.cols(), at.rowStride(), at.colStride()});
  }
  template <typename Derived>
  void Apply(Eigen::MatrixBase<Derived>& rows) const {
    Apply(std::move(rows));
  }

 private:
  struct StridedRows {
    double* data;
    Eigen::Index num_rows, num_columns, row_stride, column_stride;
  };
  // Not a template: Eigen's products of every width would be compiled in every user.
  void ApplyTo(const StridedRows& rows) const;

  std::vector<Eigen::Vector2d> a_;
  Eigen::Matrix2d g_;
};

}  // namespace groundglass
