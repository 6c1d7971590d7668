// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/pointed_prior.h"

#include "register/control_point_cost.h"
#include "register/standard_normal_cost.h"
#include "scene/symmetric_eigen.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace groundglass {
namespace {

// Sum over the samples of their variance along the normal, px^2.
double SumOfVariances(const CameraPrior& prior, const std::vector<EdgeSample>& samples) {
  const ParameterProjection projection = prior.ProjectionAt(CameraParameters::Zero());
  double sum = 0;
  for (const ProjectedSample& sample : ProjectSamples(samples, projection)) {
    if (sample.is_valid) sum += (sample.jacobian * prior.root).squaredNorm();
  }
  return sum;
}

}  // namespace

PointedPrior NarrowByPoints(const std::vector<ControlPoint>& points, const CameraPrior& prior) {
  PointedPrior pointed;
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

double NarrowingOf(const PointedPrior& pointed,
                   const CameraPrior& prior,
                   const std::vector<EdgeSample>& samples) {
  const double before = SumOfVariances(prior, samples);
  const double after = SumOfVariances(pointed.prior, samples);
  return before > 0 ? std::min(1.0, std::sqrt(after / before)) : 1;
}

double ControlPointNats(const std::vector<ControlPoint>& points,
                        const ParameterProjection& projection) {
  double nats = 0;
  for (const ControlPoint& point : points) {
    const auto projected = projection.Project(point.point_in_world);
    const double sigmas =
        projected ? (projected->image_px - point.image_px).norm() / point.sigma_px : 1000;
    nats -= 0.5 * sigmas * sigmas;
  }
  return nats;
}

void JudgeControlPoints(const std::vector<ControlPoint>& points,
                        const ParameterProjection& projection,
                        double scale,
                        double max_sigmas,
                        Registration& registration) {
  for (const ControlPoint& point : points) {
    char text[200];
    const Eigen::Vector2d at = point.image_px / scale;
    const auto projected = projection.Project(point.point_in_world);
    if (!projected) {
      std::snprintf(
          text, sizeof text, "the control point at %.0f %.0f is behind the camera", at.x(), at.y());
    } else {
      const double distance_px = (projected->image_px - point.image_px).norm();
      if (distance_px <= max_sigmas * point.sigma_px) continue;
      std::snprintf(text,
                    sizeof text,
                    "the control point at %.0f %.0f is seen %.1f px away, %.1f of its sigmas",
                    at.x(),
                    at.y(),
                    distance_px / scale,
                    distance_px / point.sigma_px);
    }
    registration.reasons.emplace_back(text);
    registration.verdict = std::max(registration.verdict, Verdict::kReview);
  }
}

}  // namespace groundglass
