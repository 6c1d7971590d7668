// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// A straight edge in a photograph; pixels as in `image` (docs/frames.md).
struct LineSegment {
  Eigen::Vector2d begin_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d end_px = Eigen::Vector2d::Zero();

  Eigen::Vector2d Middle() const { return (begin_px + end_px) / 2; }
  Eigen::Vector2d Direction() const { return (end_px - begin_px).normalized(); }
  double Length() const { return (end_px - begin_px).norm(); }
};

// Edges of 8-bit sRGB grey as line segments at least this long (px): LSD (Grompone von Gioi et al.,
// PAMI 2010) finds them, and each is fitted again to the places of steepest gradient along it.
// In a fixed order, longest first.
std::vector<LineSegment> FindLineSegments(const Image8& srgb_grey, double shortest_px);

}  // namespace groundglass
