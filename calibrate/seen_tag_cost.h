// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "calibrate/surveyed_tags.h"
#include "scene/camera_model.h"
#include "scene/view_tag.h"

#include <Eigen/Dense>

#include <cmath>

namespace groundglass {

// A surveyed tag with its corners in the photograph.
struct SeenTag {
  SurveyedTag place;
  Eigen::Matrix<double, 8, 1> corners_px;
  Eigen::Matrix<double, 8, 8> root_information;  // of an edge point's noise of 1 px
};

// View angle (radians), shift_x, shift_y, k1 and aspect, as in a view file.
constexpr int kNumTagLens = 5;
using TagLens = Eigen::Matrix<double, kNumTagLens, 1>;

// Whitened residual of a tag's corners, in units of an edge point's noise:
//   r = S (p - o),  S^T S = information,  p_i = project(lens, R (X_i + d) + t)
// with project as in scene/view_tag.h. Blocks: rotation 4 (cam_from_world, unit quaternion
// x y z w), translation 3 (model's unit), lens 5 (TagLens), d 3: how far the whole tag stands from
// its surveyed place (model's unit). Residual 8. A corner behind the camera fails the evaluation.
struct SeenTagCost {
  SeenTag seen;
  ViewTag fixed;  // its k2, k3, p1, p2
  double width_px = 0;
  double height_px = 0;

  template <typename T>
  bool operator()(
      const T* rotation, const T* translation, const T* lens, const T* offset, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> cam_from_world(rotation);
    const Eigen::Map<const Eigen::Vector3<T>> world_origin_in_cam(translation);
    const Eigen::Map<const Eigen::Vector3<T>> off(offset);
    using std::tan;
    const T focal_x_px = T(0.5 * width_px) / tan(0.5 * lens[0]);
    const T focal_y_px = focal_x_px * lens[4] * T(height_px / width_px);
    const T center_x_px = T(width_px) * (0.5 + lens[1]);
    const T center_y_px = T(0.5 * height_px) + lens[2] * T(width_px) * focal_y_px / focal_x_px;
    Distortion<T> distortion;
    distortion.k1 = lens[3];
    distortion.k2 = T(fixed.k2);
    distortion.k3 = T(fixed.k3);
    distortion.p1 = T(fixed.p1);
    distortion.p2 = T(fixed.p2);
    Eigen::Matrix<T, 8, 1> missed_px;
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector3<T> in_world =
          seen.place.corners_in_world.col(corner).template cast<T>() + off;
      const Eigen::Vector3<T> in_cam = cam_from_world * in_world + world_origin_in_cam;
      if (in_cam.z() <= T(0)) return false;
      const Eigen::Matrix<T, 2, 1> distorted =
          Distort<T>(distortion, {in_cam.x() / in_cam.z(), in_cam.y() / in_cam.z()});
      missed_px[2 * corner] = focal_x_px * distorted[0] + center_x_px - seen.corners_px[2 * corner];
      missed_px[2 * corner + 1] =
          focal_y_px * distorted[1] + center_y_px - seen.corners_px[2 * corner + 1];
    }
    Eigen::Map<Eigen::Matrix<T, 8, 1>> result(residuals);
    result = seen.root_information.cast<T>() * missed_px;
    return true;
  }
};

}  // namespace groundglass
