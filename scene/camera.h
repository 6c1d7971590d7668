// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera_model.h"
#include "scene/frames.h"

#include <Eigen/Dense>

#include <optional>

namespace groundglass {

// What projects: a pinhole with a lens' distortion on normalised coordinates (camera_model.h), as
// COLMAP's OPENCV model, or FULL_OPENCV with k4 = k5 = k6 = 0:
//   (x', y') = Distort(point_in_cam.xy / z),  image = (focal_x x' + center_x, focal_y y' +
//   center_y)
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

  Distortion<double> LensDistortion() const { return {k1, k2, k3, p1, p2}; }
  // False: straight lines have straight images.
  bool IsDistorted() const { return !IsNone(LensDistortion()); }
  Eigen::Vector3d PositionInWorld() const {
    return -(cam_from_world.rotation.transpose() * cam_from_world.translation);
  }
  // The optical axis, unit length.
  Eigen::Vector3d ForwardInWorld() const { return cam_from_world.rotation.row(2).transpose(); }
};

// The image point (pixels) of a point in `cam`; nothing behind the camera's plane, nor where the
// distortion has folded the image over.
std::optional<Eigen::Vector2d> ProjectFromCam(const Camera& camera,
                                              const Eigen::Vector3d& point_in_cam);
std::optional<Eigen::Vector2d> Project(const Camera& camera, const Eigen::Vector3d& point_in_world);

// The image point of normalised coordinates, wherever they are.
Eigen::Vector2d ImageFromNormalised(const Camera& camera, const Eigen::Vector2d& normalised);
// Its derivative, px for one unit along x and y.
Eigen::Matrix2d ImageFromNormalisedDerivative(const Camera& camera,
                                              const Eigen::Vector2d& normalised);

// The direction in `cam`, with z = 1, of the ray that meets the image at `image_px`.
Eigen::Vector3d UnprojectToCam(const Camera& camera, const Eigen::Vector2d& image_px);
// The same ray's unit direction in `world`; it starts at camera.PositionInWorld().
Eigen::Vector3d UnprojectToWorld(const Camera& camera, const Eigen::Vector2d& image_px);

// True if the image point lies inside the frame.
bool IsInsideFrame(const Camera& camera, const Eigen::Vector2d& image_px);

// The same camera for an image resampled to another size (x and y scale apart).
Camera ResizedCamera(const Camera& camera, int width_px, int height_px);

// The same camera for the image turned clockwise by quarter turns.
Camera TurnedCamera(const Camera& camera, int quarter_turns);

}  // namespace groundglass
