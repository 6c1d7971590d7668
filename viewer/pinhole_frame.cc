// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/pinhole_frame.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Beyond this many focal lengths from the axis (80 degrees) a pinhole frame would be mostly empty.
constexpr double kMaxTangent = 5.67;

Eigen::Vector2d UndistortedPoint(const Camera& camera, const Eigen::Vector2d& image_px) {
  const Eigen::Vector2d point = UnprojectToCam(camera, image_px).hnormalized();
  const double radius = point.norm();
  return radius > kMaxTangent ? Eigen::Vector2d(point * (kMaxTangent / radius)) : point;
}

// The largest eigenvalue of a symmetric matrix.
double LargestStretch(const Eigen::Matrix2d& derivative) {
  return derivative.trace() / 2 +
         std::hypot((derivative(0, 0) - derivative(1, 1)) / 2, derivative(0, 1));
}

}  // namespace

PinholeFrame MakePinholeFrame(const Camera& camera, double scale, int max_size_px) {
  PinholeFrame frame;
  frame.pinhole = camera;
  frame.pinhole.k1 = frame.pinhole.k2 = frame.pinhole.k3 = 0;
  frame.pinhole.p1 = frame.pinhole.p2 = 0;
  frame.is_bent = camera.IsDistorted();
  if (!frame.is_bent) {
    frame.pinhole = ResizedCamera(frame.pinhole,
                                  static_cast<int>(std::lround(scale * camera.width_px)),
                                  static_cast<int>(std::lround(scale * camera.height_px)));
    return frame;
  }

  constexpr int kStep = PinholeFrame::kGridStep;
  frame.grid_width = (camera.width_px + kStep - 1) / kStep + 1;
  frame.grid_height = (camera.height_px + kStep - 1) / kStep + 1;
  std::vector<Eigen::Vector2d> undistorted(static_cast<size_t>(frame.grid_width) *
                                           frame.grid_height);
  tbb::parallel_for(0, frame.grid_height, [&](int row) {
    for (int column = 0; column < frame.grid_width; ++column) {
      undistorted[static_cast<size_t>(row) * frame.grid_width + column] =
          UndistortedPoint(camera, {1.0 * kStep * column, 1.0 * kStep * row});
    }
  });

  Eigen::AlignedBox2d bounds;
  double magnification = 1;
  for (const Eigen::Vector2d& point : undistorted) {
    bounds.extend(point);
    magnification = std::max(
        magnification,
        std::min(3.0,
                 LargestStretch(DistortionDerivative<double>(camera.LensDistortion(), point))));
  }
  // Two pixels of margin on each side for the interpolation between pixels.
  const Eigen::Vector2d focal_px(camera.focal_x_px, camera.focal_y_px);
  const Eigen::Vector2d natural_px = bounds.sizes().cwiseProduct(focal_px);
  const double fit = std::min(scale * magnification, (max_size_px - 5) / natural_px.maxCoeff());
  const Eigen::Vector2d focal_scaled_px = fit * focal_px;
  const Eigen::Vector2d size_px = fit * natural_px;
  frame.pinhole.width_px = static_cast<int>(std::ceil(size_px.x())) + 4;
  frame.pinhole.height_px = static_cast<int>(std::ceil(size_px.y())) + 4;
  frame.pinhole.focal_x_px = focal_scaled_px.x();
  frame.pinhole.focal_y_px = focal_scaled_px.y();
  frame.pinhole.center_x_px = 2 - bounds.min().x() * focal_scaled_px.x();
  frame.pinhole.center_y_px = 2 - bounds.min().y() * focal_scaled_px.y();

  frame.grid_px.reserve(undistorted.size());
  const Eigen::Vector2d center_px(frame.pinhole.center_x_px, frame.pinhole.center_y_px);
  for (const Eigen::Vector2d& point : undistorted) {
    frame.grid_px.push_back((point.cwiseProduct(focal_scaled_px) + center_px).cast<float>());
  }
  return frame;
}

Eigen::Matrix4d ClipFromCam(const Camera& pinhole, double near_depth, double far_depth) {
  const double width = pinhole.width_px;
  const double height = pinhole.height_px;
  Eigen::Matrix4d clip_from_cam = Eigen::Matrix4d::Zero();
  clip_from_cam(0, 0) = 2 * pinhole.focal_x_px / width;
  clip_from_cam(0, 2) = 2 * pinhole.center_x_px / width - 1;
  clip_from_cam(1, 1) = 2 * pinhole.focal_y_px / height;
  clip_from_cam(1, 2) = 2 * pinhole.center_y_px / height - 1;
  clip_from_cam(2, 2) = (far_depth + near_depth) / (far_depth - near_depth);
  clip_from_cam(2, 3) = -2 * far_depth * near_depth / (far_depth - near_depth);
  clip_from_cam(3, 2) = 1;
  return clip_from_cam;
}

}  // namespace groundglass
