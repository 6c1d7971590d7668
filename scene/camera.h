// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/frames.h"

#include <Eigen/Dense>

#include <optional>

namespace groundglass {

// What projects: a pinhole with radial distortion on normalised coordinates, as COLMAP's and
// OpenCV's OPENCV model with p1 = p2 = 0:
//   (x, y) = point_in_cam.xy / z,  r2 = x^2 + y^2,  s = 1 + k1 r2 + k2 r2^2
//   image  = (focal_x s x + center_x, focal_y s y + center_y)
struct Camera {
  int width_px = 0;
  int height_px = 0;
  double focal_x_px = 1;
  double focal_y_px = 1;
  double center_x_px = 0;
  double center_y_px = 0;
  double k1 = 0;
  double k2 = 0;
  double k3 = 0;
  double p1 = 0;
  double p2 = 0;
  RigidTransform cam_from_world;

  Eigen::Vector3d PositionInWorld() const {
    return -(cam_from_world.rotation.transpose() * cam_from_world.translation);
  }
  // The optical axis, unit length.
  Eigen::Vector3d ForwardInWorld() const { return cam_from_world.rotation.row(2).transpose(); }
};

// The image point (pixels) of a point in `cam`; nothing behind the camera's plane, nor where the
// distortion polynomial has turned back on itself.
std::optional<Eigen::Vector2d> ProjectFromCam(const Camera& camera,
                                              const Eigen::Vector3d& point_in_cam);
std::optional<Eigen::Vector2d> Project(const Camera& camera, const Eigen::Vector3d& point_in_world);

// The direction in `cam`, with z = 1, of the ray that meets the image at `image_px`.
Eigen::Vector3d UnprojectToCam(const Camera& camera, const Eigen::Vector2d& image_px);
// The same ray's unit direction in `world`; it starts at camera.PositionInWorld().
Eigen::Vector3d UnprojectToWorld(const Camera& camera, const Eigen::Vector2d& image_px);

// True if the image point lies inside the frame.
bool IsInsideFrame(const Camera& camera, const Eigen::Vector2d& image_px);

// The same camera for an image resampled to another size (x and y scale apart).
Camera ResizedCamera(const Camera& camera, int width_px, int height_px);

}  // namespace groundglass
