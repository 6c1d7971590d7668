// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/camera_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace groundglass {
namespace {

// How much of the chi-squared distribution lies above a value: the sum that the recurrence of the
// incomplete gamma function gives for whole degrees of freedom (Abramowitz and Stegun 26.4.4-5).
double ChiSquaredTail(double value, int degrees_of_freedom) {
  const double half = value / 2;
  const bool is_odd = degrees_of_freedom % 2 == 1;
  double tail = is_odd ? std::erfc(std::sqrt(half)) : std::exp(-half);
  // half^(n/2) exp(-half) / gamma(n/2 + 1), for n from 1 or 2 on in steps of 2.
  double term = std::exp(-half) * (is_odd ? 2 * std::sqrt(half / std::numbers::pi) : half);
  for (int n = is_odd ? 1 : 2; n < degrees_of_freedom; n += 2) {
    tail += term;
    term *= half / (n / 2.0 + 1);
  }
  return tail;
}

// An angle's difference brought to [-180, 180).
double WrapDegrees(double angle_deg) { return angle_deg - 360 * std::floor(angle_deg / 360 + 0.5); }

}  // namespace

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
  for (const int angle : {kYaw, kPitch, kRoll})
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
  // Rounding may take a covariance that is all but singular below zero: it holds nothing then.
  calibration.confidence = calibration.mahalanobis_squared >= 0
                               ? 1 - ChiSquaredTail(calibration.mahalanobis_squared, n)
                               : 1;
  calibration.is_inside_95 = calibration.confidence <= 0.95;
  return calibration;
}

}  // namespace groundglass
