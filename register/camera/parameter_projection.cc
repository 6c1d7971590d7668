// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/parameter_projection.h"

#include "scene/frames.h"

#include <cmath>

namespace groundglass {

ParameterProjection::ParameterProjection(const CameraParameters& parameters,
                                         const Distortion<double>& lens,
                                         int width_px,
                                         int height_px)
    : width_px_(width_px), lens_(lens) {
  lens_.k1 = parameters[kK1];
  position_in_world_ = parameters.head<3>();
  const double yaw = RadiansFromDegrees(parameters[kYaw]);
  const double pitch = RadiansFromDegrees(parameters[kPitch]);
  const double roll = RadiansFromDegrees(parameters[kRoll]);
  const double sin_yaw = std::sin(yaw), cos_yaw = std::cos(yaw);
  const double sin_pitch = std::sin(pitch), cos_pitch = std::cos(pitch);
  const double sin_roll = std::sin(roll), cos_roll = std::cos(roll);

  // Rows of the level camera (right, down, forward) in `world`, and their derivatives.
  Eigen::Matrix3d level, level_by_yaw, level_by_pitch;
  level << sin_yaw, -cos_yaw, 0, sin_pitch * cos_yaw, sin_pitch * sin_yaw, -cos_pitch,
      cos_yaw * cos_pitch, sin_yaw * cos_pitch, sin_pitch;
  level_by_yaw << cos_yaw, sin_yaw, 0, -sin_pitch * sin_yaw, sin_pitch * cos_yaw, 0,
      -sin_yaw * cos_pitch, cos_yaw * cos_pitch, 0;
  level_by_pitch << 0, 0, 0, cos_pitch * cos_yaw, cos_pitch * sin_yaw, sin_pitch,
      -cos_yaw * sin_pitch, -sin_yaw * sin_pitch, cos_pitch;
  Eigen::Matrix3d turn, turn_by_roll;
  turn << cos_roll, sin_roll, 0, -sin_roll, cos_roll, 0, 0, 0, 1;
  turn_by_roll << -sin_roll, cos_roll, 0, -cos_roll, -sin_roll, 0, 0, 0, 0;
  rotation_ = turn * level;
  rotation_by_yaw_ = turn * level_by_yaw / kDegreesPerRadian;
  rotation_by_pitch_ = turn * level_by_pitch / kDegreesPerRadian;
  rotation_by_roll_ = turn_by_roll * level / kDegreesPerRadian;

  const double half_angle = RadiansFromDegrees(parameters[kViewAngle]) / 2;
  const double aspect = parameters[kAspect];
  focal_x_px_ = width_px / 2.0 / std::tan(half_angle);
  focal_x_by_view_angle_ =
      -width_px / 4.0 / (std::sin(half_angle) * std::sin(half_angle)) / kDegreesPerRadian;
  focal_y_by_focal_x_ = aspect * height_px / width_px;
  focal_y_px_ = focal_x_px_ * focal_y_by_focal_x_;
  focal_y_by_aspect_ = focal_x_px_ * height_px / width_px;
  center_x_px_ = width_px / 2.0 + parameters[kShiftX] * width_px;
  center_y_px_ = height_px / 2.0 + parameters[kShiftY] * aspect * height_px;
  center_y_by_aspect_ = parameters[kShiftY] * height_px;
  center_y_by_shift_ = aspect * height_px;
}

std::optional<Eigen::Vector2d> ParameterProjection::NormalisedFromCam(
    const Eigen::Vector3d& point_in_cam) const {
  if (!(point_in_cam.z() > 0)) return std::nullopt;
  const Eigen::Vector2d normalised = point_in_cam.head<2>() * (1 / point_in_cam.z());
  if (!IsBeforeFold(lens_, normalised)) return std::nullopt;
  return normalised;
}

std::optional<Eigen::Vector2d> ParameterProjection::ImageOf(
    const Eigen::Vector3d& point_in_world) const {
  const auto normalised = NormalisedFromCam(rotation_ * (point_in_world - position_in_world_));
  if (!normalised) return std::nullopt;
  return ImageFromDistorted(Distort<double>(lens_, *normalised));
}

std::optional<ParameterProjection::Result> ParameterProjection::Project(
    const Eigen::Vector3d& point_in_world) const {
  const Eigen::Vector3d offset = point_in_world - position_in_world_;
  const Eigen::Vector3d in_cam = rotation_ * offset;
  const auto seen = NormalisedFromCam(in_cam);
  if (!seen) return std::nullopt;
  const Eigen::Vector2d& normalised = *seen;
  const double inverse_z = 1 / in_cam.z();
  const double x = normalised.x();
  const double y = normalised.y();
  const Eigen::Vector2d distorted = Distort<double>(lens_, normalised);

  Result result;
  result.image_px = ImageFromDistorted(distorted);
  result.px_per_unit = focal_x_px_ * inverse_z;

  // d image / d (x, y), then d (x, y) / d point_in_cam.
  const Eigen::Matrix2d by_normalised = Eigen::Vector2d(focal_x_px_, focal_y_px_).asDiagonal() *
                                        DistortionDerivative<double>(lens_, normalised);
  Eigen::Matrix<double, 2, 3> normalised_by_cam;
  normalised_by_cam << inverse_z, 0, -x * inverse_z, 0, inverse_z, -y * inverse_z;
  const Eigen::Matrix<double, 2, 3> by_cam = by_normalised * normalised_by_cam;

  auto& jacobian = result.jacobian;
  jacobian.leftCols<3>() = -by_cam * rotation_;
  jacobian.col(kYaw) = by_cam * (rotation_by_yaw_ * offset);
  jacobian.col(kPitch) = by_cam * (rotation_by_pitch_ * offset);
  jacobian.col(kRoll) = by_cam * (rotation_by_roll_ * offset);
  jacobian.col(kViewAngle) =
      Eigen::Vector2d(distorted.x(), distorted.y() * focal_y_by_focal_x_) * focal_x_by_view_angle_;
  jacobian.col(kAspect) =
      Eigen::Vector2d(0, distorted.y() * focal_y_by_aspect_ + center_y_by_aspect_);
  jacobian.col(kShiftX) = Eigen::Vector2d(width_px_, 0);
  jacobian.col(kShiftY) = Eigen::Vector2d(0, center_y_by_shift_);
  const double r2 = normalised.squaredNorm();
  jacobian.col(kK1) = Eigen::Vector2d(focal_x_px_ * x * r2, focal_y_px_ * y * r2);
  return result;
}

}  // namespace groundglass
