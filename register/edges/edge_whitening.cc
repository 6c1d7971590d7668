// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_whitening.h"

#include <cmath>

namespace groundglass {

EdgeWhitening::EdgeWhitening(std::span<const AlignedSample> samples) {
  a_.reserve(samples.size());
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (const AlignedSample& sample : samples) {
    const Eigen::Vector2d& a = a_.emplace_back(std::sqrt(sample.precision) * sample.bias_px);
    xx += a.x() * a.x();
    xy += a.x() * a.y();
    yy += a.y() * a.y();
  }
  // The eigenvectors of the symmetric matrix [xx xy; xy yy] are its Jacobi rotation's.
  const double turn = 0.5 * std::atan2(2 * xy, xx - yy);
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  const auto shrink = [](double l) { return l > 1e-12 ? (1 - 1 / std::sqrt(1 + l)) / l : 0.0; };
  const double first = shrink(c * c * xx + 2 * c * s * xy + s * s * yy);
  const double second = shrink(s * s * xx - 2 * c * s * xy + c * c * yy);
  const double across = c * s * (first - second);
  g_ << c * c * first + s * s * second, across, across, s * s * first + c * c * second;
}

void EdgeWhitening::ApplyTo(const StridedRows& rows) const {
  for (Eigen::Index column = 0; column < rows.num_columns; ++column) {
    double* const top = rows.data + column * rows.column_stride;
    Eigen::Vector2d inner = Eigen::Vector2d::Zero();
    for (Eigen::Index i = 0; i < rows.num_rows; ++i) {
      inner += top[i * rows.row_stride] * a_[static_cast<size_t>(i)];
    }
    inner = g_ * inner;
    for (Eigen::Index i = 0; i < rows.num_rows; ++i) {
      top[i * rows.row_stride] -= a_[static_cast<size_t>(i)].dot(inner);
    }
  }
}

}  // namespace groundglass
