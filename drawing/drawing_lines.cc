// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/drawing_lines.h"

#include "scene/feature_edges.h"
#include "scene/visibility.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace groundglass {
namespace {

struct Interval {
  double start = 0;
  double end = 0;
};

std::vector<Interval> Joined(std::vector<Interval> intervals, double gap) {
  std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) {
    return std::pair(a.start, a.end) < std::pair(b.start, b.end);
  });
  std::vector<Interval> joined;
  for (const Interval& interval : intervals) {
    if (!joined.empty() && interval.start <= joined.back().end + gap) {
      joined.back().end = std::max(joined.back().end, interval.end);
    } else {
      joined.push_back(interval);
    }
  }
  return joined;
}

// Where a plane cuts a face, as stretches of the straight line in which the two planes meet.
std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> CutFace(const PolygonModel& model,
                                                                 int face,
                                                                 const DrawingPlane& plane,
                                                                 double tolerance) {
  const Eigen::Vector3d normal = plane.TowardsViewer();
  const Eigen::Vector3d along =
      normal.cross(ComputeFacePlane(model, face).normal_in_world).normalized();
  std::vector<Interval> intervals;
  Eigen::Vector3d on_line = Eigen::Vector3d::Zero();
  for (const std::array<int, 3>& triangle : TriangulateFace(model, face)) {
    std::vector<Eigen::Vector3d> crossings;
    for (int side = 0; side < 3; ++side) {
      const Eigen::Vector3d& a = model.points_in_world[triangle[side]];
      const Eigen::Vector3d& b = model.points_in_world[triangle[(side + 1) % 3]];
      const double height_a = normal.dot(a - plane.origin_in_world);
      const double height_b = normal.dot(b - plane.origin_in_world);
      if ((height_a > 0) == (height_b > 0)) continue;
      crossings.push_back(a + height_a / (height_a - height_b) * (b - a));
    }
    if (crossings.size() != 2) continue;
    const double first = along.dot(crossings[0]);
    const double second = along.dot(crossings[1]);
    on_line = crossings[0] - first * along;
    intervals.push_back({std::min(first, second), std::max(first, second)});
  }
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> cuts;
  for (const Interval& interval : Joined(intervals, tolerance)) {
    cuts.emplace_back(on_line + interval.start * along, on_line + interval.end * along);
  }
  return cuts;
}

}  // namespace

std::vector<DrawnLine> FindDrawnLines(const PolygonModel& model,
                                      const Drawing& drawing,
                                      double pixel_size) {
  const DrawingGrid grid = MakeGrid(drawing, pixel_size);
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  const Visibility visibility(model);
  const double metres = MetresPerUnit(model.unit);
  std::vector<DrawnLine> lines;
  for (const PanelView& part : MakePanelViews(drawing, grid)) {
    const OrthographicView& view = part.view;
    const auto add = [&](const Eigen::Vector3d& start_in_world,
                         const Eigen::Vector3d& end_in_world,
                         DrawnLine::Kind kind) {
      const auto on_sheet = [&](const Eigen::Vector3d& point_in_world) -> Eigen::Vector2d {
        const Eigen::Vector3d px = view.FromWorld(point_in_world);
        return metres *
               Eigen::Vector2d(drawing.UStart() + (part.first_column + px.x()) * grid.pixel_size,
                               drawing.v_end - px.y() * grid.pixel_size);
      };
      lines.push_back({on_sheet(start_in_world), on_sheet(end_in_world), kind});
    };
    for (const VisibleSpan& span : FindVisibleSpans(model, edges, visibility, view, 0)) {
      add(span.start_in_world,
          span.end_in_world,
          span.is_silhouette ? DrawnLine::Kind::kOutline : DrawnLine::Kind::kEdge);
    }
    if (!drawing.is_section) continue;
    for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
      const DrawingPlane& plane = drawing.panels[part.panel].plane;
      for (const auto& [start, end] : CutFace(model, face, plane, visibility.DefaultTolerance())) {
        add(start, end, DrawnLine::Kind::kCut);
      }
    }
  }
  return lines;
}

}  // namespace groundglass
