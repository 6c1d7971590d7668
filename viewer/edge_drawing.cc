// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/edge_drawing.h"

#include <algorithm>
#include <cmath>

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

namespace {

// The parts of a bent line that are drawn, each a straight piece.
template <typename Draw>
void ForEachDash(const std::vector<Eigen::Vector2d>& points,
                 const EdgeStyle& style,
                 const Draw& draw) {
  const double period_px = style.dash_px + style.gap_px;
  const bool is_whole = style.dash_px <= 0 || style.gap_px <= 0;
  double done_px = 0;  // along the line
  for (size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d& start = points[i - 1];
    const Eigen::Vector2d way = points[i] - start;
    const double length_px = way.norm();
    if (is_whole) {
      draw(start, points[i]);
      continue;
    }
    if (length_px == 0) continue;
    const auto at = [&](double along_px) -> Eigen::Vector2d {
      return start + way * std::clamp((along_px - done_px) / length_px, 0.0, 1.0);
    };
    for (double dash = std::floor(done_px / period_px); dash * period_px < done_px + length_px;
         ++dash) {
      const double from_px = std::max(done_px, dash * period_px);
      const double to_px = std::min(done_px + length_px, dash * period_px + style.dash_px);
      if (to_px > from_px) draw(at(from_px), at(to_px));
    }
    done_px += length_px;
  }
}

}  // namespace

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
    ForEachDash(points, style, [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
      AddLine(line, from, to, width_px);
      if (has_casing) AddLine(casing, from, to, width_px + 2 * style.casing_px);
    });
  }
  if (has_casing) LayOver(srgb8, casing, style.casing_colour, style.casing_opacity);
  LayOver(srgb8, line, style.colour, style.opacity);
}

}  // namespace groundglass
