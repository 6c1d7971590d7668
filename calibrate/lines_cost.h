// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

#include <cmath>

namespace groundglass {

// Blocks: lens 4 (log of the focal length, principal point x and y, k1; shares of the width) and
// the building's directions, a unit quaternion x y z w.
constexpr int kNumLens = 4;
using LensNumbers = Eigen::Matrix<double, kNumLens, 1>;

// How far a segment's ends lie from the line through its middle towards a vanishing point, in
// standard deviations:
//   r = (length / 2) sin(angle between the segment and the direction's picture at its middle) / s
struct SegmentCost {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  // its middle, shares of the width
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
  double half_length_in_sigmas = 0;
  int axis = 0;

  template <typename T>
  bool operator()(const T* lens, const T* rotation, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> cam_from_building(rotation);
    const Eigen::Vector3<T> axis_in_cam =
        cam_from_building * Eigen::Vector3<T>(Eigen::Vector3d::Unit(axis).cast<T>());
    const T focal = exp(lens[0]);
    const T& k1 = lens[3];
    const Eigen::Vector2<T> distorted((place.x() - lens[1]) / focal, (place.y() - lens[2]) / focal);
    Eigen::Vector2<T> straight = distorted;
    for (int i = 0; i < 6; ++i) straight = distorted / (1.0 + k1 * straight.squaredNorm());
    const Eigen::Vector2<T> towards = axis_in_cam.template head<2>() - axis_in_cam.z() * straight;
    const Eigen::Vector2<T> seen =
        (1.0 + k1 * straight.squaredNorm()) * towards + 2.0 * k1 * straight.dot(towards) * straight;
    residual[0] = half_length_in_sigmas * (seen.x() * direction.y() - seen.y() * direction.x()) /
                  sqrt(seen.squaredNorm() + 1e-18);
    return true;
  }
};

// What is known of any lens: the focal length hardly, principal point and k1 to the options'
// sigmas.
struct LensPriorCost {
  LensNumbers mean, sigmas;
  template <typename T>
  bool operator()(const T* lens, T* residuals) const {
    for (int i = 0; i < kNumLens; ++i) residuals[i] = (lens[i] - mean[i]) / sigmas[i];
    return true;
  }
};

}  // namespace groundglass
