// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// OpenGL projects straight lines to straight lines. A camera whose lens bends them is drawn in two
// steps: a pinhole frame, in general larger, that holds all that the lens sees; and for each pixel
// of the camera's frame, where in the pinhole frame it is found.
struct PinholeFrame {
  // As the camera but without distortion, its frame and focal length in the pinhole frame's pixels.
  Camera pinhole;
  // True if the camera has distortion: `grid_px` is empty otherwise.
  bool is_bent = false;
  // Where the camera's image points (kGridStep * column, kGridStep * row) lie in the pinhole
  // frame, px, row by row; in between linearly.
  static constexpr int kGridStep = 4;
  int grid_width = 0;
  int grid_height = 0;
  std::vector<Eigen::Vector2f> grid_px;
};

// scale: pinhole pixels for each of the camera's (supersampling), along each axis. The frame grows
// further where the lens magnifies, and shrinks to fit max_size_px.
PinholeFrame MakePinholeFrame(const Camera& camera, double scale, int max_size_px);

// Clip coordinates of OpenGL from `cam` (w is z forward). Row 0 of the framebuffer is the image's
// top row, and image (0.5, 0.5) is the first pixel's centre, as OpenGL has it; so pictures need no
// turning over, but front faces come out clockwise.
Eigen::Matrix4d ClipFromCam(const Camera& pinhole, double near_depth, double far_depth);

}  // namespace groundglass
