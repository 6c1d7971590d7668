// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/edge_alignment_cost.h"

#include "register/camera/parameter_projection.h"
#include "register/edges/edge_whitening.h"

#include <cmath>

namespace groundglass {

EdgeAlignmentCost::EdgeAlignmentCost(const std::vector<AlignedSample>& samples,
                                     const CameraPrior& prior)
    : samples_(samples), prior_(prior) {
  set_num_residuals(static_cast<int>(samples.size()));
  mutable_parameter_block_sizes()->push_back(kNumCameraParameters);
}

bool EdgeAlignmentCost::Evaluate(double const* const* parameters,
                                 double* residuals,
                                 double** jacobians) const {
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, kNumCameraParameters, Eigen::RowMajor>;
  const Eigen::Map<const CameraParameters> whitened(parameters[0]);
  const ParameterProjection projection = prior_.ProjectionAt(whitened);
  const auto count = static_cast<Eigen::Index>(samples_.size());
  Eigen::Map<Eigen::VectorXd> r(residuals, count);
  const bool with_jacobian = jacobians && jacobians[0];
  Eigen::Map<Jacobian> by_whitened(
      with_jacobian ? jacobians[0] : nullptr, with_jacobian ? count : 0, kNumCameraParameters);
  for (Eigen::Index i = 0; i < count; ++i) {
    const AlignedSample& sample = samples_[i];
    const auto image_px = projection.ImageOf(sample.point_in_world);
    if (!image_px) return false;
    const double weight = std::sqrt(sample.precision);
    r[i] = weight * (sample.normal.dot(*image_px - sample.origin_px) - sample.offset_px);
    if (with_jacobian) {
      const auto projected = projection.Project(sample.point_in_world);
      by_whitened.row(i) = weight * (sample.normal.transpose() * projected->jacobian) * prior_.root;
    }
  }

  for (Eigen::Index start = 0; start < count;) {
    Eigen::Index end = start;
    while (end < count && samples_[end].edge == samples_[start].edge) ++end;
    const EdgeWhitening whitening({&samples_[start], static_cast<size_t>(end - start)});
    whitening.Apply(r.segment(start, end - start));
    if (with_jacobian) whitening.Apply(by_whitened.middleRows(start, end - start));
    start = end;
  }
  return true;
}

}  // namespace groundglass
