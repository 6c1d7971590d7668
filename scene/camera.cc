// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/camera.h"

namespace groundglass {

std::optional<Eigen::Vector2d> ProjectFromCam(const Camera& camera,
                                              const Eigen::Vector3d& point_in_cam) {
  if (!(point_in_cam.z() > 0)) return std::nullopt;
  const Eigen::Vector2d normalised(point_in_cam.x() / point_in_cam.z(),
                                   point_in_cam.y() / point_in_cam.z());
  if (camera.IsDistorted() && !IsBeforeFold(camera.LensDistortion(), normalised))
    return std::nullopt;
  return ImageFromNormalised(camera, normalised);
}

Eigen::Vector2d ImageFromNormalised(const Camera& camera, const Eigen::Vector2d& normalised) {
  const Eigen::Vector2d distorted =
      camera.IsDistorted() ? Distort<double>(camera.LensDistortion(), normalised) : normalised;
  return {camera.focal_x_px * distorted.x() + camera.center_x_px,
          camera.focal_y_px * distorted.y() + camera.center_y_px};
}

Eigen::Matrix2d ImageFromNormalisedDerivative(const Camera& camera,
                                              const Eigen::Vector2d& normalised) {
  Eigen::Matrix2d derivative = DistortionDerivative<double>(camera.LensDistortion(), normalised);
  derivative.row(0) *= camera.focal_x_px;
  derivative.row(1) *= camera.focal_y_px;
  return derivative;
}

std::optional<Eigen::Vector2d> Project(const Camera& camera,
                                       const Eigen::Vector3d& point_in_world) {
  return ProjectFromCam(camera, camera.cam_from_world * point_in_world);
}

Eigen::Vector3d UnprojectToCam(const Camera& camera, const Eigen::Vector2d& image_px) {
  Eigen::Vector2d normalised((image_px.x() - camera.center_x_px) / camera.focal_x_px,
                             (image_px.y() - camera.center_y_px) / camera.focal_y_px);
  if (camera.IsDistorted()) normalised = Undistort(camera.LensDistortion(), normalised);
  return {normalised.x(), normalised.y(), 1};
}

Eigen::Vector3d UnprojectToWorld(const Camera& camera, const Eigen::Vector2d& image_px) {
  return (camera.cam_from_world.rotation.transpose() * UnprojectToCam(camera, image_px))
      .normalized();
}

bool IsInsideFrame(const Camera& camera, const Eigen::Vector2d& image_px) {
  return image_px.x() >= 0 && image_px.y() >= 0 && image_px.x() <= camera.width_px &&
         image_px.y() <= camera.height_px;
}

Camera ResizedCamera(const Camera& camera, int width_px, int height_px) {
  const double scale_x = static_cast<double>(width_px) / camera.width_px;
  const double scale_y = static_cast<double>(height_px) / camera.height_px;
  Camera resized = camera;
  resized.width_px = width_px;
  resized.height_px = height_px;
  resized.focal_x_px *= scale_x;
  resized.center_x_px *= scale_x;
  resized.focal_y_px *= scale_y;
  resized.center_y_px *= scale_y;
  return resized;
}

Camera TurnedCamera(const Camera& camera, int quarter_turns) {
  Camera turned = camera;
  for (int i = 0; i < ((quarter_turns % 4) + 4) % 4; ++i) {
    const Camera before = turned;
    // What was right is down, what was down is left.
    Eigen::Matrix3d turn;
    turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    turned.width_px = before.height_px;
    turned.height_px = before.width_px;
    turned.focal_x_px = before.focal_y_px;
    turned.focal_y_px = before.focal_x_px;
    turned.center_x_px = before.height_px - before.center_y_px;
    turned.center_y_px = before.center_x_px;
    // (p2, p1) is a direction in the image plane.
    turned.p2 = -before.p1;
    turned.p1 = before.p2;
    turned.cam_from_world.rotation = turn * before.cam_from_world.rotation;
    turned.cam_from_world.translation = turn * before.cam_from_world.translation;
  }
  return turned;
}

}  // namespace groundglass
