// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/rules.h"

#include "scene/camera_check.h"
#include "scene/error.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

double HalfLongerSide(const Camera& camera) {
  return std::max(camera.width_px, camera.height_px) / 2.0;
}

Eigen::Vector2d Middle(const Camera& camera) {
  return {camera.width_px / 2.0, camera.height_px / 2.0};
}

Eigen::Vector2d Center(const Camera& camera) { return {camera.center_x_px, camera.center_y_px}; }

void SetCenter(const Eigen::Vector2d& center_px, Camera& camera) {
  camera.center_x_px = center_px.x();
  camera.center_y_px = center_px.y();
}

}  // namespace

Eigen::Matrix4d WorldFromGlCam(const Camera& camera) {
  Eigen::Matrix4d world_from_gl_cam = Eigen::Matrix4d::Identity();
  world_from_gl_cam.topLeftCorner<3, 3>() =
      camera.cam_from_world.rotation.transpose() * GlFromCam();
  world_from_gl_cam.topRightCorner<3, 1>() = camera.PositionInWorld();
  return world_from_gl_cam;
}

void SetPoseFromGlCam(const Eigen::Matrix4d& world_from_gl_cam, Camera& camera) {
  camera.cam_from_world.rotation =
      GlFromCam() * NearestRotation(world_from_gl_cam.topLeftCorner<3, 3>()).transpose();
  camera.cam_from_world.translation =
      -(camera.cam_from_world.rotation * world_from_gl_cam.topRightCorner<3, 1>());
}

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& matrix) {
  constexpr double kMostRounding = 0.01;
  const double determinant = matrix.determinant();
  if (!std::isfinite(determinant) || determinant == 0) {
    throw Error("the camera's matrix is no rotation: its determinant is " +
                std::string(determinant == 0 ? "0" : "not finite"));
  }
  if (determinant < 0) {
    throw Error(
        "the camera's matrix mirrors (its determinant is below 0); expected a rotation, and a y "
        "or z axis may be the wrong way round");
  }
  const Eigen::Matrix3d unscaled = matrix / std::cbrt(determinant);
  const Eigen::Matrix3d gram = unscaled.transpose() * unscaled;
  if (!((gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kMostRounding)) {
    throw Error(
        "the camera's matrix is no rotation: its axes are not at right angles, or not of one "
        "length");
  }
  return Eigen::Quaterniond(unscaled).normalized().toRotationMatrix();
}

HeadingPitchRoll HeadingPitchRollOf(const Camera& camera) {
  const Eigen::Matrix3d r = WorldFromGlCam(camera).topLeftCorner<3, 3>();
  const double level = std::hypot(r(2, 0), r(2, 2));
  HeadingPitchRoll angles;
  angles.pitch_deg = DegreesFromRadians(std::atan2(r(2, 1), level));
  if (level > 1e-9) {
    angles.heading_deg = DegreesFromRadians(std::atan2(r(0, 1), r(1, 1)));
    angles.roll_deg = DegreesFromRadians(std::atan2(-r(2, 0), r(2, 2)));
  } else {
    angles.heading_deg = -DegreesFromRadians(std::atan2(r(1, 0), r(0, 0)));
  }
  return angles;
}

void SetSize(double width_px, double height_px, Camera& camera) {
  const std::string fault = FindSizeFault(width_px, height_px);
  if (!fault.empty()) throw Error(fault);
  camera.width_px = static_cast<int>(width_px);
  camera.height_px = static_cast<int>(height_px);
}

Eigen::Vector2d CenterFromMiddle(const Camera& camera) { return Center(camera) - Middle(camera); }
void SetCenterFromMiddle(const Eigen::Vector2d& from_middle_px, Camera& camera) {
  SetCenter(Middle(camera) + from_middle_px, camera);
}

Eigen::Vector2d CenterFromBelow(const Camera& camera) {
  return {camera.center_x_px, camera.height_px - camera.center_y_px};
}
void SetCenterFromBelow(const Eigen::Vector2d& from_below_px, Camera& camera) {
  SetCenter({from_below_px.x(), camera.height_px - from_below_px.y()}, camera);
}

Eigen::Vector2d CenterOnImagePlane(const Camera& camera) {
  const Eigen::Vector2d from_middle = CenterFromMiddle(camera) / HalfLongerSide(camera);
  return {from_middle.x(), -from_middle.y()};
}
void SetCenterOnImagePlane(const Eigen::Vector2d& on_plane, Camera& camera) {
  SetCenterFromMiddle(HalfLongerSide(camera) * Eigen::Vector2d(on_plane.x(), -on_plane.y()),
                      camera);
}

Eigen::Vector2d CenterAsShare(const Camera& camera) {
  return {camera.center_x_px / camera.width_px, camera.center_y_px / camera.height_px};
}

Eigen::Vector2d BlenderShift(const Camera& camera) {
  const Eigen::Vector2d shift = -CenterFromMiddle(camera) / camera.width_px;
  return {shift.x(), -shift.y() * camera.focal_x_px / camera.focal_y_px};
}

FieldOfView FieldOfViewOf(const Camera& camera) {
  const auto angle = [](double px, double focal_px) {
    return DegreesFromRadians(std::atan(px / focal_px));
  };
  return {-angle(camera.center_x_px, camera.focal_x_px),
          angle(camera.width_px - camera.center_x_px, camera.focal_x_px),
          -angle(camera.height_px - camera.center_y_px, camera.focal_y_px),
          angle(camera.center_y_px, camera.focal_y_px)};
}

}  // namespace groundglass
