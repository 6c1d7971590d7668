// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/camera.h"

#include <cmath>

namespace groundglass {
namespace {

// d/dr of r (1 + k1 r^2 + k2 r^4); where it is not positive the image folds over.
double DistortedRadiusSlope(const Camera& camera, double r2) {
  return 1 + 3 * camera.k1 * r2 + 5 * camera.k2 * r2 * r2;
}

// Newton's method for the undistorted radius; the polynomial is monotone where images exist.
double UndistortRadius(const Camera& camera, double distorted_radius) {
  double r = distorted_radius;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const double r2 = r * r;
    const double value = r * (1 + camera.k1 * r2 + camera.k2 * r2 * r2) - distorted_radius;
    const double slope = DistortedRadiusSlope(camera, r2);
    if (slope <= 0.05) {
      // Past the fold there is no inverse: step back towards the centre.
      r *= 0.8;
      continue;
    }
    const double step = value / slope;
    r -= step;
    if (std::abs(step) < 1e-15 * (1 + r)) break;
  }
  return r;
}

}  // namespace

std::optional<Eigen::Vector2d> ProjectFromCam(const Camera& camera,
                                              const Eigen::Vector3d& point_in_cam) {
  if (!(point_in_cam.z() > 0)) return std::nullopt;
  const double x = point_in_cam.x() / point_in_cam.z();
  const double y = point_in_cam.y() / point_in_cam.z();
  const double r2 = x * x + y * y;
  const bool distorted = camera.k1 != 0 || camera.k2 != 0;
  if (distorted && DistortedRadiusSlope(camera, r2) <= 0) return std::nullopt;
  const double s = 1 + camera.k1 * r2 + camera.k2 * r2 * r2;
  return Eigen::Vector2d(camera.focal_x_px * s * x + camera.center_x_px,
                         camera.focal_y_px * s * y + camera.center_y_px);
}

std::optional<Eigen::Vector2d> Project(const Camera& camera,
                                       const Eigen::Vector3d& point_in_world) {
  return ProjectFromCam(camera, camera.cam_from_world * point_in_world);
}

Eigen::Vector3d UnprojectToCam(const Camera& camera, const Eigen::Vector2d& image_px) {
  Eigen::Vector2d normalised((image_px.x() - camera.center_x_px) / camera.focal_x_px,
                             (image_px.y() - camera.center_y_px) / camera.focal_y_px);
  if (camera.k1 != 0 || camera.k2 != 0) {
    const double distorted_radius = normalised.norm();
    if (distorted_radius > 0) {
      normalised *= UndistortRadius(camera, distorted_radius) / distorted_radius;
    }
  }
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

}  // namespace groundglass
