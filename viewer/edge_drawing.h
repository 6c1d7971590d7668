// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/feature_edges.h"
#include "scene/image.h"
#include "viewer/line_drawing.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// How the model's edges are drawn over a picture: a line, on a casing of another colour that
// keeps it apart from whatever lies below. Silhouettes may be wider.
struct EdgeStyle {
  Srgb8Colour colour = {28, 28, 34};
  double opacity = 1;
  double width_px = 1.2;
  double silhouette_width_px = 1.8;
  Srgb8Colour casing_colour = {16, 16, 20};
  double casing_opacity = 0;  // 0: no casing
  double casing_px = 0;       // on each side of the line
  // Dashes so long, with round ends, and gaps between them; 0: the whole line.
  double dash_px = 0;
  double gap_px = 0;
};

// The unit in which line widths are counted, so that drawings look alike at all sizes: 1 px for a
// picture of 1200 px, never less than 0.75.
double LineUnit(const Image8& picture);

// Draws spans (FindVisibleSpans, with a margin of EdgeMargin) as the camera sees them.
void DrawEdges(Image8& srgb8,
               const std::vector<VisibleSpan>& spans,
               const Camera& camera,
               const EdgeStyle& style);
// How far outside the frame a line can lie and still be seen in it, px.
double EdgeMargin(const EdgeStyle& style);

// A span as the camera's distortion bends it: image points, px, a few pixels apart along a bent
// line; two points where lines stay straight; none if an end cannot be seen.
std::vector<Eigen::Vector2d> ProjectSpan(const Camera& camera,
                                         const Eigen::Vector3d& start_in_world,
                                         const Eigen::Vector3d& end_in_world);

}  // namespace groundglass
