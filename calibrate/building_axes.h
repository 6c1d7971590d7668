// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "calibrate/line_segments.h"

#include <Eigen/Dense>

#include <cstdint>
#include <span>
#include <vector>

namespace groundglass {

// A camera's numbers as lines tell them: everything in shares of the picture's width, pixels
// square.
struct LinesCamera {
  double focal = 1;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // principal point from the picture's middle
  double k1 = 0;
  // Its columns are the building's three directions in `cam`: two level ones, and the vertical,
  // which points down in the picture.
  Eigen::Matrix3d axes_in_cam = Eigen::Matrix3d::Identity();
};

// The direction in the picture (unit length) of a line through this place (shares of the width from
// the picture's middle) that runs along a direction of space; zero where the place is the
// direction's vanishing point.
Eigen::Vector2d DirectionInPicture(const LinesCamera& camera,
                                   const Eigen::Vector2d& place,
                                   const Eigen::Vector3d& direction_in_cam);

// Cameras whose three perpendicular directions many segments follow, best first, for each of
// several focal lengths: from pairs of segments that meet in one vanishing point and a third that
// gives the second (after Rother, BMVC 2000, with the focal length tried and not computed). The
// vertical is within 45 degrees of the picture's.

std::vector<LinesCamera> FindBuildingAxes(std::span<const LineSegment> segments,
                                          const Eigen::Vector2d& middle_px,
                                          double width_px,
                                          uint64_t seed);

}  // namespace groundglass
