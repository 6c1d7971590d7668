// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/control_point_posterior.h"

#include "register/camera/control_point_cost.h"
#include "register/camera/standard_normal_cost.h"
#include "scene/symmetric_eigen.h"

#include <ceres/ceres.h>

#include <cmath>

namespace groundglass {
ControlPointPosterior ConditionOnControlPoints(const std::vector<ControlPoint>& points,
                                               const CameraPrior& prior) {
  ControlPointPosterior pointed;
  pointed.prior = prior;
  if (points.empty()) return pointed;

  ceres::Problem::Options problem_options;
  problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ControlPointCost pointing(points, prior);
  StandardNormalCost<kNumCameraParameters> whitened_prior;
  CameraParameters whitened = CameraParameters::Zero();
  ceres::Problem problem(problem_options);
  problem.AddResidualBlock(&pointing, nullptr, whitened.data());
  problem.AddResidualBlock(&whitened_prior, nullptr, whitened.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 100;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return pointed;

  const auto num_residuals = static_cast<Eigen::Index>(2 * points.size());
  Eigen::VectorXd residuals(num_residuals);
  Eigen::Matrix<double, Eigen::Dynamic, kNumCameraParameters, Eigen::RowMajor> jacobian(
      num_residuals, kNumCameraParameters);
  const double* blocks[] = {whitened.data()};
  double* jacobians[] = {jacobian.data()};
  if (!pointing.Evaluate(blocks, residuals.data(), jacobians)) return pointed;
  const CameraCovariance information =
      CameraCovariance::Identity() + jacobian.transpose() * jacobian;
  pointed.offset = whitened;
  const SymmetricEigen eigen = DecomposeSymmetric(information);
  pointed.map = eigen.vectors * eigen.values.cwiseSqrt().cwiseInverse().asDiagonal() *
                eigen.vectors.transpose();
  pointed.prior.mean = prior.ParametersAt(whitened);
  pointed.prior.root = prior.root * pointed.map;
  pointed.prior.sigmas = pointed.prior.root.rowwise().norm();
  return pointed;
}

double ControlPointNats(const std::vector<ControlPoint>& points,
                        const ParameterProjection& projection) {
  double nats = 0;
  for (const ControlPoint& point : points) {
    const auto seen_px = projection.ImageOf(point.point_in_world);
    const double sigmas = seen_px ? (*seen_px - point.image_px).norm() / point.sigma_px : 1000;
    nats -= 0.5 * sigmas * sigmas;
  }
  return nats;
}

}  // namespace groundglass
