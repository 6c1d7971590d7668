// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "calibrate/april_tag_detection.h"
#include "scene/camera.h"
#include "scene/image.h"

#include <Eigen/Dense>

#include <optional>

namespace groundglass {

// An AprilTag's corners as measured: x0 y0 x1 y1 ... in pixels, in the order of AprilTagDetection.
struct AprilTagCorners {
  int id = 0;
  Eigen::Matrix<double, 8, 1> corners_px;
  // Inverse covariance for an edge point's noise of 1 px: neighbouring corners share an edge, so
  // their errors go together.
  Eigen::Matrix<double, 8, 8> information;
  // Of its edges, one standard deviation, pixels; 0 if it could not be seen. Corners of blurred
  // ones are known less.
  double blur_px = 0;
};

// Measures an AprilTag's corners in linear light as the meeting points of its four black edges.
// Each edge is a straight line fitted through its subpixel crossings after the lens' distortion is
// taken out (`lens`: intrinsics only), which keeps blur and rounding at the corners out of it;
// Datta, Kim & Kanade 2009 show why measuring again with a better lens pays. Soft edges, and those
// of small AprilTags, beside whose levels other cells lie, are taken where they are half as bright
// as between the AprilTag's black and the white beside it. `gap_share`: the white gap beside the
// AprilTag, as a share of the AprilTag's size. Nothing if the AprilTag is too small, leaves the
// frame, or an edge is hidden.
std::optional<AprilTagCorners> MeasureAprilTagCorners(const ImageF& radiance_grey,
                                                      const AprilTagDetection& start,
                                                      double gap_share,
                                                      const Camera& lens);
// The same in 8-bit sRGB grey, whose codes are turned into light first.
std::optional<AprilTagCorners> MeasureAprilTagCorners(const Image8& srgb_grey,
                                                      const AprilTagDetection& start,
                                                      double gap_share,
                                                      const Camera& lens);

}  // namespace groundglass
