// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/image_edge_error.h"

#include <cmath>

namespace groundglass {

ImageEdgeError EstimateImageEdgeError(std::span<const AlignedSample> samples,
                                      std::span<const double> residuals_px,
                                      double degrees_of_freedom) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d push = Eigen::Vector2d::Zero();
  for (size_t i = 0; i < samples.size(); ++i) {
    const AlignedSample& sample = samples[i];
    information += sample.precision * sample.bias_px * sample.bias_px.transpose();
    push += sample.precision * residuals_px[i] * sample.bias_px;
  }
  constexpr int kDimensions = 2;
  constexpr int kSteps = 20;  // settles to a per cent
  double variance = 1;
  double squared = 0;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Matrix2d covariance =
        (information + Eigen::Matrix2d::Identity() / variance).inverse();
    squared = (covariance * push).squaredNorm() + covariance.trace();
    variance = (degrees_of_freedom + squared) / (degrees_of_freedom + kDimensions);
  }
  return {std::sqrt(variance), squared / variance / kDimensions};
}

}  // namespace groundglass
