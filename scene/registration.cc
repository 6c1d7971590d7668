// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/registration.h"

#include "scene/frames.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// The unit view axis.
Eigen::Vector3d AxisInWorld(double yaw_deg, double pitch_deg) {
  const double yaw = RadiansFromDegrees(yaw_deg);
  const double pitch = RadiansFromDegrees(pitch_deg);
  return {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)};
}

double LookatDistance(const ViewTag& tag) {
  return (tag.lookat_in_site - tag.position_in_site).norm();
}

}  // namespace

CameraParameters ParametersFromTag(const ViewTag& tag) {
  const Eigen::Vector3d axis = WorldFromSite(tag.lookat_in_site - tag.position_in_site);
  CameraParameters parameters;
  parameters.head<3>() = WorldFromSite(tag.position_in_site);
  parameters[kYaw] = DegreesFromRadians(std::atan2(axis.y(), axis.x()));
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

CameraParameters SiteParameters(const CameraParameters& in_world) {
  CameraParameters in_site = SiteChange(in_world);
  in_site[kYaw] = std::remainder(in_site[kYaw] + 90, 360.0);
  return in_site;
}

CameraParameters SiteChange(const CameraParameters& change_in_world) {
  CameraParameters change_in_site = change_in_world;
  change_in_site[kPositionY] *= -1;
  return change_in_site;
}

CameraCovariance SiteCovariance(const CameraCovariance& in_world) {
  CameraCovariance in_site = in_world;
  in_site.row(kPositionY) *= -1;
  in_site.col(kPositionY) *= -1;
  return in_site;
}

ViewTag TagFromParameters(const CameraParameters& parameters, const ViewTag& measured) {
  ViewTag tag = measured;
  const Eigen::Vector3d position_in_world = parameters.head<3>();
  tag.position_in_site = SiteFromWorld(position_in_world);
  tag.lookat_in_site =
      SiteFromWorld(position_in_world +
                    LookatDistance(measured) * AxisInWorld(parameters[kYaw], parameters[kPitch]));
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
      Eigen::Vector3d(-std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch), 0);
  lookat_jacobian.col(kPitch) =
      distance / kDegreesPerRadian *
      Eigen::Vector3d(
          -std::cos(yaw) * std::sin(pitch), -std::sin(yaw) * std::sin(pitch), std::cos(pitch));
  // Variances, the same in `site` and in `world`.
  const Eigen::Vector3d lookat_variance =
      (lookat_jacobian * covariance * lookat_jacobian.transpose()).diagonal();

  TagDeviations deviations{};
  const auto set = [&](TagKey key, double variance) {
    deviations[static_cast<int>(key)] = std::sqrt(std::max(0.0, variance));
  };
  set(TagKey::kX, covariance(kPositionX, kPositionX));
  set(TagKey::kY, covariance(kPositionY, kPositionY));
  set(TagKey::kZ, covariance(kPositionZ, kPositionZ));
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
