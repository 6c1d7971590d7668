// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

namespace groundglass {

// What a lens does to normalised image coordinates (x, y) = point_in_cam.xy / z: COLMAP's and
// OpenCV's OPENCV model with k3 (Brown, Photogrammetric Engineering 1966):
//   s  = 1 + k1 r2 + k2 r2^2 + k3 r2^3,  r2 = x^2 + y^2
//   x' = s x + 2 p1 x y + p2 (r2 + 2 x^2)
//   y' = s y + p1 (r2 + 2 y^2) + 2 p2 x y
// The one place that knows it. T is double, or a number that carries derivatives.
template <typename T>
struct Distortion {
  T k1 = T(0);
  T k2 = T(0);
  T k3 = T(0);
  T p1 = T(0);
  T p2 = T(0);
};

inline bool IsNone(const Distortion<double>& lens) {
  return lens.k1 == 0 && lens.k2 == 0 && lens.k3 == 0 && lens.p1 == 0 && lens.p2 == 0;
}

template <typename T>
Eigen::Matrix<T, 2, 1> Distort(const Distortion<T>& lens, const Eigen::Matrix<T, 2, 1>& point) {
  const T& x = point[0];
  const T& y = point[1];
  const T r2 = x * x + y * y;
  const T s = 1.0 + lens.k1 * r2 + lens.k2 * r2 * r2 + lens.k3 * r2 * r2 * r2;
  // Together the tangential terms are (p2, p1) r2 + 2 (x, y) (p2 x + p1 y).
  const T along = 2.0 * (lens.p2 * x + lens.p1 * y);
  return {s * x + (lens.p2 * r2 + along * x), s * y + (lens.p1 * r2 + along * y)};
}

// d Distort / d point: symmetric, since the distortion is the gradient of a function.
template <typename T>
Eigen::Matrix<T, 2, 2> DistortionDerivative(const Distortion<T>& lens,
                                            const Eigen::Matrix<T, 2, 1>& point) {
  const T& x = point[0];
  const T& y = point[1];
  const T r2 = x * x + y * y;
  const T s = 1.0 + lens.k1 * r2 + lens.k2 * r2 * r2 + lens.k3 * r2 * r2 * r2;
  const T s_by_r2 = lens.k1 + 2.0 * lens.k2 * r2 + 3.0 * lens.k3 * r2 * r2;
  const T mixed = 2.0 * x * y * s_by_r2 + 2.0 * (lens.p1 * x + lens.p2 * y);
  Eigen::Matrix<T, 2, 2> derivative;
  derivative(0, 0) = s + 2.0 * x * x * s_by_r2 + (6.0 * lens.p2 * x + 2.0 * lens.p1 * y);
  derivative(0, 1) = mixed;
  derivative(1, 0) = mixed;
  derivative(1, 1) = s + 2.0 * y * y * s_by_r2 + (6.0 * lens.p1 * y + 2.0 * lens.p2 * x);
  return derivative;
}

// Whether the image has not folded over between the centre and this place: what lies beyond the
// fold has an image a second time, or in what belongs to others, and no lens shows it.
bool IsBeforeFold(const Distortion<double>& lens, const Eigen::Vector2d& point);

// The point whose distortion this is, by Newton's method; where the lens shows nothing (beyond the
// image of its fold), a point at the fold in about that direction.
Eigen::Vector2d Undistort(const Distortion<double>& lens, const Eigen::Vector2d& distorted);

}  // namespace groundglass
