// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/charts/charts.h"

#include "scene/face_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace groundglass {
namespace {

// The nearest point of a segment.
Eigen::Vector2d NearestOnSegment(const Eigen::Vector2d& point,
                                 const Eigen::Vector2d& start,
                                 const Eigen::Vector2d& end) {
  const Eigen::Vector2d along = end - start;
  const double squared = along.squaredNorm();
  if (squared == 0) return start;
  return start + std::clamp((point - start).dot(along) / squared, 0.0, 1.0) * along;
}

// True if the two segments lie on one line and share more than a point of it.
bool Overlap(const Eigen::Vector3d& a0,
             const Eigen::Vector3d& a1,
             const Eigen::Vector3d& b0,
             const Eigen::Vector3d& b1,
             double tolerance) {
  const double length = (a1 - a0).norm();
  if (length <= tolerance) return false;
  const Eigen::Vector3d along = (a1 - a0) / length;
  const auto off_line = [&](const Eigen::Vector3d& p) {
    return ((p - a0) - (p - a0).dot(along) * along).norm();
  };
  if (off_line(b0) > tolerance || off_line(b1) > tolerance) return false;
  const double first = (b0 - a0).dot(along);
  const double second = (b1 - a0).dot(along);
  const double overlap =
      std::min(length, std::max(first, second)) - std::max(0.0, std::min(first, second));
  return overlap > 4 * tolerance;
}

bool Touch(const PolygonModel& model, int first, int second, double tolerance) {
  const std::vector<int>& a = model.faces[first].points;
  const std::vector<int>& b = model.faces[second].points;
  for (size_t i = 0; i < a.size(); ++i) {
    for (size_t j = 0; j < b.size(); ++j) {
      if (Overlap(model.points_in_world[a[i]],
                  model.points_in_world[a[(i + 1) % a.size()]],
                  model.points_in_world[b[j]],
                  model.points_in_world[b[(j + 1) % b.size()]],
                  tolerance)) {
        return true;
      }
    }
  }
  return false;
}

// Faces that lie in one plane, face the same way and touch: a root for each face.
std::vector<int> MergeCoplanar(const PolygonModel& model, const ChartOptions& options) {
  const int num_faces = static_cast<int>(model.faces.size());
  std::vector<int> root(num_faces);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int face) {
    while (root[face] != face) face = root[face] = root[root[face]];
    return face;
  };
  const double size = std::max(ComputeBounds(model).Diagonal(), 1e-12);
  const double tolerance = options.coplanar_share * size;
  std::vector<FacePlane> planes(num_faces);
  // Candidates share a coarse block of normal; neighbouring blocks are missed, which only costs a
  // merge.
  std::map<std::array<long, 4>, std::vector<int>> groups;
  for (int face = 0; face < num_faces; ++face) {
    planes[face] = ComputeFacePlane(model, face);
    const Eigen::Vector3d& n = planes[face].normal_in_world;
    groups[{std::lround(n.x() * 500),
            std::lround(n.y() * 500),
            std::lround(n.z() * 500),
            std::lround(planes[face].offset / size * 500)}]
        .push_back(face);
  }
  for (const auto& [key, faces] : groups) {
    for (size_t i = 0; i < faces.size(); ++i) {
      for (size_t j = i + 1; j < faces.size(); ++j) {
        const FacePlane& a = planes[faces[i]];
        const FacePlane& b = planes[faces[j]];
        if (a.normal_in_world.cross(b.normal_in_world).norm() > options.coplanar_sine) continue;
        if (a.normal_in_world.dot(b.normal_in_world) < 0) continue;
        if (std::abs(a.offset - b.offset) > tolerance) continue;
        const int first = find(faces[i]);
        const int second = find(faces[j]);
        if (first == second || !Touch(model, faces[i], faces[j], tolerance)) continue;
        root[std::max(first, second)] = std::min(first, second);
      }
    }
  }
  for (int face = 0; face < num_faces; ++face) root[face] = find(face);
  return root;
}

// Axes of the chart: upright for walls and roofs, along the longest edge for level faces.
void SetAxes(const PolygonModel& model, const ChartOptions& options, Chart& chart) {
  const Eigen::Vector3d& normal = chart.normal_in_world;
  Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(normal);
  if (right.norm() < options.level_sine) {
    double longest = -1;
    for (const int face : chart.faces) {
      const std::vector<int>& points = model.faces[face].points;
      for (const OutlineSide& side : FindBorders(model, face)) {
        const Eigen::Vector3d edge =
            model.points_in_world[points[side.end]] - model.points_in_world[points[side.start]];
        if (edge.norm() > longest * (1 + 1e-9)) {
          longest = edge.norm();
          right = edge - edge.dot(normal) * normal;
        }
      }
    }
  }
  chart.right_in_world = right.normalized();
  chart.down_in_world = -normal.cross(chart.right_in_world);
}

void SetExtent(const PolygonModel& model, double offset, Chart& chart) {
  chart.origin_in_world = offset * chart.normal_in_world;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300);
  Eigen::Vector2d high = -low;
  for (const int face : chart.faces) {
    for (const int point : model.faces[face].points) {
      const Eigen::Vector2d p = chart.PlanePoint(model.points_in_world[point]);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  chart.origin_in_world += low.x() * chart.right_in_world + low.y() * chart.down_in_world;
  chart.width = high.x() - low.x();
  chart.height = high.y() - low.y();
}

}  // namespace

void Chart::SetTexelSize(double size) {
  texel_size = size;
  // A hair less, so that a wall of exactly 100 texels gets 100.
  width_texels = std::max(1, static_cast<int>(std::ceil(width / size - 1e-6)));
  height_texels = std::max(1, static_cast<int>(std::ceil(height / size - 1e-6)));
}

std::vector<Chart> MakeCharts(const PolygonModel& model, const ChartOptions& options) {
  const std::vector<int> root = MergeCoplanar(model, options);
  std::map<int, std::vector<int>> members;
  for (int face = 0; face < static_cast<int>(root.size()); ++face) {
    members[root[face]].push_back(face);
  }
  std::vector<Chart> charts;
  charts.reserve(members.size());
  for (const auto& [first, faces] : members) {
    Chart& chart = charts.emplace_back();
    chart.faces = faces;
    const FacePlane plane = ComputeFacePlane(model, first);
    chart.normal_in_world = plane.normal_in_world;
    SetAxes(model, options, chart);
    SetExtent(model, plane.offset, chart);
  }
  return charts;
}

std::vector<int> ChartOfFace(const std::vector<Chart>& charts, size_t num_faces) {
  std::vector<int> chart_of_face(num_faces, -1);
  for (size_t chart = 0; chart < charts.size(); ++chart) {
    for (const int face : charts[chart].faces) chart_of_face[face] = static_cast<int>(chart);
  }
  return chart_of_face;
}

ChartTexels::ChartTexels(const PolygonModel& model, const Chart& chart)
    : faces_(chart.width_texels, chart.height_texels, 1, -1),
      inside_(chart.width_texels, chart.height_texels, 1, 0) {
  for (const int face : chart.faces) {
    Outline& outline = outlines_.emplace_back();
    outline.face = face;
    const std::vector<int>& points = model.faces[face].points;
    for (const OutlineSide& side : FindBorders(model, face)) {
      outline.sides.push_back({chart.TexelFromWorld(model.points_in_world[points[side.start]]),
                               chart.TexelFromWorld(model.points_in_world[points[side.end]])});
    }
  }
  for (const Outline& outline : outlines_) FillInside(outline);
  for (const Outline& outline : outlines_) {
    for (const Outline::Side& side : outline.sides) FillAlong(side, outline.face);
  }
}

void ChartTexels::FillInside(const Outline& outline) {
  std::vector<double> crossings;
  for (int y = 0; y < height(); ++y) {
    crossings.clear();
    const double row = y + 0.5;
    for (const auto& [a, b] : outline.sides) {
      if ((a.y() <= row) == (b.y() <= row)) continue;
      crossings.push_back(a.x() + (row - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const int first = std::max(0, static_cast<int>(std::ceil(crossings[i] - 0.5)));
      const int last =
          std::min(width() - 1, static_cast<int>(std::ceil(crossings[i + 1] - 0.5)) - 1);
      for (int x = first; x <= last; ++x) {
        *faces_.At(x, y) = outline.face;
        *inside_.At(x, y) = 1;
      }
    }
  }
}

void ChartTexels::FillAlong(const Outline::Side& side, int face) {
  constexpr double kHalfDiagonal = 0.7072;  // of a texel
  const auto& [a, b] = side;
  const int num_steps = std::max(1, static_cast<int>(std::ceil(2 * (b - a).norm())));
  for (int step = 0; step <= num_steps; ++step) {
    const Eigen::Vector2d at = a + (b - a) * step / num_steps;
    const int cx = static_cast<int>(std::floor(at.x()));
    const int cy = static_cast<int>(std::floor(at.y()));
    for (int y = std::max(0, cy - 1); y <= std::min(height() - 1, cy + 1); ++y) {
      for (int x = std::max(0, cx - 1); x <= std::min(width() - 1, cx + 1); ++x) {
        if (*faces_.At(x, y) >= 0) continue;
        const Eigen::Vector2d centre(x + 0.5, y + 0.5);
        if ((NearestOnSegment(centre, a, b) - centre).norm() <= kHalfDiagonal) {
          *faces_.At(x, y) = face;
        }
      }
    }
  }
}

Eigen::Vector2d ChartTexels::PointAt(int x, int y) const {
  Eigen::Vector2d centre(x + 0.5, y + 0.5);
  if (IsCentreInside(x, y)) return centre;
  const int face = FaceAt(x, y);
  Eigen::Vector2d best = centre;
  double best_distance = 1e300;
  for (const Outline& outline : outlines_) {
    if (outline.face != face) continue;
    for (const auto& [start, end] : outline.sides) {
      const Eigen::Vector2d point = NearestOnSegment(centre, start, end);
      const double distance = (point - centre).squaredNorm();
      if (distance < best_distance) {
        best_distance = distance;
        best = point;
      }
    }
  }
  return best;
}

}  // namespace groundglass
