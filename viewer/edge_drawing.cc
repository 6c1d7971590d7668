// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/edge_drawing.h"

#include <algorithm>

namespace groundglass {

double LineUnit(const Image8& picture) {
  return std::max(0.75, std::max(picture.width, picture.height) / 1200.0);
}

double EdgeMargin(const EdgeStyle& style) {
  return std::max(style.width_px, style.silhouette_width_px) + style.casing_px + 1;
}

std::vector<Eigen::Vector2d> ProjectSpan(const Camera& camera,
                                         const Eigen::Vector3d& start_in_world,
                                         const Eigen::Vector3d& end_in_world) {
  const auto start_px = Project(camera, start_in_world);
  const auto end_px = Project(camera, end_in_world);
  if (!start_px || !end_px) return {};
  constexpr double kPieceLengthPx = 8;
  const bool bent = camera.IsDistorted();
  const int num_pieces =
      bent ? std::clamp(static_cast<int>((*end_px - *start_px).norm() / kPieceLengthPx), 1, 1000)
           : 1;
  std::vector<Eigen::Vector2d> points = {*start_px};
  for (int i = 1; i < num_pieces; ++i) {
    const double t = static_cast<double>(i) / num_pieces;
    const auto point_px = Project(camera, (1 - t) * start_in_world + t * end_in_world);
    if (point_px) points.push_back(*point_px);
  }
  points.push_back(*end_px);
  return points;
}

void DrawEdges(Image8& srgb8,
               const std::vector<VisibleSpan>& spans,
               const Camera& camera,
               const EdgeStyle& style) {
  const bool has_casing = style.casing_opacity > 0 && style.casing_px > 0;
  CoverageMask line(srgb8.width, srgb8.height, 1);
  CoverageMask casing;
  if (has_casing) casing = line;
  for (const VisibleSpan& span : spans) {
    const double width_px = span.is_silhouette ? style.silhouette_width_px : style.width_px;
    const auto points = ProjectSpan(camera, span.start_in_world, span.end_in_world);
    for (size_t i = 1; i < points.size(); ++i) {
      AddLine(line, points[i - 1], points[i], width_px);
      if (has_casing) {
        AddLine(casing, points[i - 1], points[i], width_px + 2 * style.casing_px);
      }
    }
  }
  if (has_casing) LayOver(srgb8, casing, style.casing_colour, style.casing_opacity);
  LayOver(srgb8, line, style.colour, style.opacity);
}

}  // namespace groundglass
