// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/registration.h"

#include "scene/frames.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Indices into CameraParameters.
enum { kX, kY, kZ, kYaw, kPitch, kRoll, kViewAngle, kAspect, kShiftX, kShiftY, kK1 };

// The unit view axis in `site`: yaw from +y towards +x, as the thesis has it.
Eigen::Vector3d AxisInSite(double yaw_deg, double pitch_deg) {
  const double yaw = RadiansFromDegrees(yaw_deg);
  const double pitch = RadiansFromDegrees(pitch_deg);
  return {std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch), std::sin(pitch)};
}

double LookatDistance(const ViewTag& tag) {
  return (tag.lookat_in_site - tag.position_in_site).norm();
}

}  // namespace

CameraParameters ParametersFromTag(const ViewTag& tag) {
  const Eigen::Vector3d axis = tag.lookat_in_site - tag.position_in_site;
  CameraParameters parameters;
  parameters[kX] = tag.position_in_site.x();
  parameters[kY] = tag.position_in_site.y();
  parameters[kZ] = tag.position_in_site.z();
  parameters[kYaw] = DegreesFromRadians(std::atan2(axis.x(), axis.y()));
  // The same angle as asin(dz / distance), without its loss of digits in steep views.
  parameters[kPitch] = DegreesFromRadians(std::atan2(axis.z(), axis.head<2>().norm()));
  parameters[kRoll] = tag.roll_deg;
  parameters[kViewAngle] = tag.view_angle_deg;
  parameters[kAspect] = tag.aspect;
  parameters[kShiftX] = tag.shift_x;
  parameters[kShiftY] = tag.shift_y;
  parameters[kK1] = tag.k1;
  return parameters;
}

ViewTag TagFromParameters(const CameraParameters& parameters, const ViewTag& measured) {
  ViewTag tag = measured;
  tag.position_in_site = parameters.head<3>();
  tag.lookat_in_site = tag.position_in_site +
                       LookatDistance(measured) * AxisInSite(parameters[kYaw], parameters[kPitch]);
  tag.roll_deg = parameters[kRoll];
  tag.view_angle_deg = parameters[kViewAngle];
  tag.aspect = parameters[kAspect];
  tag.shift_x = parameters[kShiftX];
  tag.shift_y = parameters[kShiftY];
  tag.k1 = parameters[kK1];
  return tag;
}

TagDeviations TagDeviationsFromCovariance(const CameraParameters& parameters,
                                          const CameraCovariance& covariance,
                                          const ViewTag& measured) {
  // d(look-at) / d(parameters): lookat = position + distance * axis(yaw, pitch).
  const double distance = LookatDistance(measured);
  const double yaw = RadiansFromDegrees(parameters[kYaw]);
  const double pitch = RadiansFromDegrees(parameters[kPitch]);
  Eigen::Matrix<double, 3, kNumCameraParameters> lookat_jacobian =
      Eigen::Matrix<double, 3, kNumCameraParameters>::Zero();
  lookat_jacobian.leftCols<3>().setIdentity();
  lookat_jacobian.col(kYaw) =
      distance / kDegreesPerRadian *
      Eigen::Vector3d(std::cos(yaw) * std::cos(pitch), -std::sin(yaw) * std::cos(pitch), 0);
  lookat_jacobian.col(kPitch) =
      distance / kDegreesPerRadian *
      Eigen::Vector3d(
          -std::sin(yaw) * std::sin(pitch), -std::cos(yaw) * std::sin(pitch), std::cos(pitch));
  const Eigen::Vector3d lookat_variance =
      (lookat_jacobian * covariance * lookat_jacobian.transpose()).diagonal();

  TagDeviations deviations{};
  const auto set = [&](TagKey key, double variance) {
    deviations[static_cast<int>(key)] = std::sqrt(std::max(0.0, variance));
  };
  set(TagKey::kX, covariance(kX, kX));
  set(TagKey::kY, covariance(kY, kY));
  set(TagKey::kZ, covariance(kZ, kZ));
  set(TagKey::kI, lookat_variance.x());
  set(TagKey::kJ, lookat_variance.y());
  set(TagKey::kK, lookat_variance.z());
  set(TagKey::kA, covariance(kAspect, kAspect));
  set(TagKey::kV, covariance(kViewAngle, kViewAngle));
  set(TagKey::kRoll, covariance(kRoll, kRoll));
  set(TagKey::kShiftX, covariance(kShiftX, kShiftX));
  set(TagKey::kShiftY, covariance(kShiftY, kShiftY));
  set(TagKey::kK1, covariance(kK1, kK1));
  return deviations;
}

std::string_view VerdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAccepted:
      return "accepted";
    case Verdict::kReview:
      return "review";
    case Verdict::kRejected:
      return "rejected";
    case Verdict::kUnreadable:
      return "unreadable";
  }
  return "rejected";
}

}  // namespace groundglass
