// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/control_point_cost.h"

#include "register/camera/parameter_projection.h"

namespace groundglass {

ControlPointCost::ControlPointCost(const std::vector<ControlPoint>& points,
                                   const CameraPrior& prior)
    : points_(points), prior_(prior) {
  set_num_residuals(2 * static_cast<int>(points.size()));
  mutable_parameter_block_sizes()->push_back(kNumCameraParameters);
}

bool ControlPointCost::Evaluate(double const* const* parameters,
                                double* residuals,
                                double** jacobians) const {
  using Rows = Eigen::Matrix<double, 2, kNumCameraParameters, Eigen::RowMajor>;
  const Eigen::Map<const CameraParameters> whitened(parameters[0]);
  const ParameterProjection projection = prior_.ProjectionAt(whitened);
  for (size_t i = 0; i < points_.size(); ++i) {
    const ControlPoint& point = points_[i];
    const auto projected = projection.Project(point.point_in_world);
    if (!projected) return false;
    Eigen::Map<Eigen::Vector2d>(residuals + 2 * i) =
        (projected->image_px - point.image_px) / point.sigma_px;
    if (jacobians && jacobians[0]) {
      Eigen::Map<Rows>(jacobians[0] + 2 * i * kNumCameraParameters) =
          projected->jacobian * prior_.root / point.sigma_px;
    }
  }
  return true;
}

}  // namespace groundglass
