// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/tie_point_cost.h"

namespace groundglass {

TieFrame FrameOfTiePoint(const TiePoint& point, double model_sigma) {
  TieFrame frame;
  frame.at_in_world = point.point_in_world;
  if (point.april_tag >= 0) {
    frame.axes_in_world *= point.survey_sigma;
    return frame;
  }
  const Eigen::Vector3d first = point.normal_in_world.unitOrthogonal();
  frame.axes_in_world << first, point.normal_in_world.cross(first), point.normal_in_world;
  frame.axes_in_world *= model_sigma;
  return frame;
}

bool TiePointCost::Evaluate(double const* const* parameters,
                            double* residuals,
                            double** jacobians) const {
  const Eigen::Map<const CameraParameters> own(parameters[0]);
  const Eigen::Map<const LensParameters> lens(parameters[1]);
  const Eigen::Map<const Eigen::Vector3d> move(parameters[2]);
  const auto projected = prior_.ProjectionAt(own, lens).Project(frame_.PointInWorld(move));
  if (!projected) return false;
  Eigen::Map<Eigen::Vector2d> r(residuals);
  r = observation_.root_precision * (projected->image_px - observation_.image_px);
  if (!jacobians) return true;
  using ByCamera = Eigen::Matrix<double, 2, kNumCameraParameters, Eigen::RowMajor>;
  using ByLens = Eigen::Matrix<double, 2, kNumLensParameters, Eigen::RowMajor>;
  using ByPoint = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
  const ByCamera by_camera = observation_.root_precision * projected->jacobian;
  if (jacobians[0]) Eigen::Map<ByCamera>{jacobians[0]} = by_camera * prior_.own_root;
  if (jacobians[1]) Eigen::Map<ByLens>{jacobians[1]} = by_camera * prior_.lens_root;
  if (jacobians[2]) {
    // Moving the point is moving the camera the other way.
    Eigen::Map<ByPoint>{jacobians[2]} = -by_camera.leftCols<3>() * frame_.axes_in_world;
  }
  return true;
}

bool ReliefPriorCost::Evaluate(double const* const* parameters,
                               double* residuals,
                               double** jacobians) const {
  residuals[0] = parameters[0][2] / sigmas_;
  if (jacobians && jacobians[0]) {
    jacobians[0][0] = jacobians[0][1] = 0;
    jacobians[0][2] = 1 / sigmas_;
  }
  return true;
}

}  // namespace groundglass
