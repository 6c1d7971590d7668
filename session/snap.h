// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <optional>

namespace groundglass {

struct SnapOptions {
  double reach_px = 3;   // a pin moves no farther
  double window_px = 4;  // gradients this near count, by a bell curve of half this width
  double corner_share =
      0.1;  // a corner's weaker direction has this share of the stronger's evidence
  double least_contrast = 4;  // grey levels a pixel across what is snapped to; less is grain

  void Check() const;  // throws Error naming the first field out of range
};

// Where the picture's own corner or edge is that a person points at: the place that all lines
// through the gradients near it pass nearest, to a fraction of a pixel; of a straight edge the
// nearest place on it. Nothing where there is neither within reach. px, pixels' centres at halves.
//
// Foerstner and Guelch (1987).
std::optional<Eigen::Vector2d> SnapToPicture(const Image8& srgb8,
                                             const Eigen::Vector2d& image_px,
                                             const SnapOptions& options = {});

}  // namespace groundglass
