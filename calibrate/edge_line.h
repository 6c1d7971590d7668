// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

#include <optional>
#include <vector>

namespace groundglass {

// A line in undistorted pixels: points p with normal . p = offset. The deviations of its two ends
// from the truth have this covariance for crossings with a noise of 1 px.
struct EdgeLine {
  Eigen::Vector2d normal;
  double offset = 0;
  Eigen::Matrix2d end_covariance;
};

// Least squares through the points, without outliers; nothing if too few are left.
std::optional<EdgeLine> FitLine(std::vector<Eigen::Vector2d> points,
                                const Eigen::Vector2d& start,
                                const Eigen::Vector2d& end);

}  // namespace groundglass
