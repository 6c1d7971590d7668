// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/camera_errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace groundglass {
namespace {

// The 95 % point of the chi-squared distribution, to 0.1 % (Wilson and Hilferty 1931).
double ChiSquared95(int degrees_of_freedom) {
  const double n = degrees_of_freedom;
  if (degrees_of_freedom == 1) return 3.8415;
  if (degrees_of_freedom == 2) return 5.9915;
  const double root = 1 - 2 / (9 * n) + 1.6448536 * std::sqrt(2 / (9 * n));
  return n * root * root * root;
}

// An angle's difference brought to [-180, 180).
double WrapDegrees(double angle_deg) { return angle_deg - 360 * std::floor(angle_deg / 360 + 0.5); }

}  // namespace

VertexError MeasureVertexError(const PolygonModel& model,
                               const Camera& true_camera,
                               const Camera& found_camera) {
  VertexError error;
  double sum_px = 0;
  for (const Eigen::Vector3d& point_in_world : model.points_in_world) {
    const auto true_px = Project(true_camera, point_in_world);
    if (!true_px || !IsInsideFrame(true_camera, *true_px)) continue;
    const auto found_px = Project(found_camera, point_in_world);
    if (!found_px) continue;
    const double distance_px = (*found_px - *true_px).norm();
    sum_px += distance_px;
    error.max_px = std::max(error.max_px, distance_px);
    ++error.num_points;
  }
  if (error.num_points > 0) error.mean_px = sum_px / error.num_points;
  return error;
}

double WrongAcceptedThresholdPx(int width_px) { return 3.0 * width_px / 640.0; }

CameraErrors MeasureCameraErrors(const PolygonModel& model,
                                 const Camera& true_camera,
                                 const Camera& found_camera) {
  CameraErrors errors;
  errors.vertex = MeasureVertexError(model, true_camera, found_camera);
  errors.position = (found_camera.PositionInWorld() - true_camera.PositionInWorld()).norm();
  const Eigen::Vector3d true_forward = true_camera.ForwardInWorld();
  const Eigen::Vector3d found_forward = found_camera.ForwardInWorld();
  // The arc tangent keeps its digits for small angles, where the arc cosine loses half of them.
  errors.direction_deg = DegreesFromRadians(
      std::atan2(true_forward.cross(found_forward).norm(), true_forward.dot(found_forward)));
  errors.parameters = ParametersFromTag(TagFromCamera(found_camera, 1)) -
                      ParametersFromTag(TagFromCamera(true_camera, 1));
  for (const int angle : {3, 4, 5})
    errors.parameters[angle] = WrapDegrees(errors.parameters[angle]);
  return errors;
}

std::optional<Calibration> MeasureCalibration(const CameraParameters& errors,
                                              const CameraCovariance& covariance) {
  std::vector<int> known;
  for (int i = 0; i < kNumCameraParameters; ++i) {
    if (covariance(i, i) > 0) known.push_back(i);
  }
  if (known.empty()) return std::nullopt;
  const int n = static_cast<int>(known.size());
  // Units differ by orders of magnitude (feet, degrees, fractions): solve in units of sigma.
  Eigen::MatrixXd correlation(n, n);
  Eigen::VectorXd standardised(n);
  for (int i = 0; i < n; ++i) {
    const double sigma_i = std::sqrt(covariance(known[i], known[i]));
    standardised[i] = errors[known[i]] / sigma_i;
    for (int j = 0; j < n; ++j) {
      correlation(i, j) =
          covariance(known[i], known[j]) / (sigma_i * std::sqrt(covariance(known[j], known[j])));
    }
  }
  Calibration calibration;
  calibration.degrees_of_freedom = n;
  calibration.mahalanobis_squared = standardised.dot(correlation.ldlt().solve(standardised));
  calibration.is_inside_95 =
      calibration.mahalanobis_squared >= 0 && calibration.mahalanobis_squared <= ChiSquared95(n);
  return calibration;
}

}  // namespace groundglass
