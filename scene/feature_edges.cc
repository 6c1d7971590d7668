// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/feature_edges.h"

#include "scene/model_sigma.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace groundglass {
namespace {

// Borders that differ by less than this share of the model's size are the same border; those too
// that differ by far less than what is known of its edges, since exporters round the corners of
// each face by themselves.
constexpr double kWeldTolerance = 1e-6;
constexpr double kWeldShareOfSigma = 1.0 / 30;

double WeldTolerance(const PolygonModel& model) {
  // Who says that a model is coarse has not said that its details are none.
  const double sigma = std::min(ModelSigma(model), DefaultModelSigma(model));
  return std::max(
      {1e-12, kWeldTolerance * ComputeBounds(model).Diagonal(), kWeldShareOfSigma * sigma});
}

// One number for all points at (almost) the same place, so that faces which do not share point
// numbers still share borders.
std::vector<int> WeldPoints(const PolygonModel& model, double tolerance) {
  const auto cell = [&](const Eigen::Vector3d& p) {
    return std::array<long, 3>{std::lround(p.x() / (4 * tolerance)),
                               std::lround(p.y() / (4 * tolerance)),
                               std::lround(p.z() / (4 * tolerance))};
  };
  std::map<std::array<long, 3>, std::vector<int>> cells;
  std::vector<int> weld(model.points_in_world.size());
  for (int point = 0; point < static_cast<int>(weld.size()); ++point) {
    const Eigen::Vector3d& p = model.points_in_world[point];
    weld[point] = point;
    const std::array<long, 3> center = cell(p);
    for (long dx = -1; dx <= 1 && weld[point] == point; ++dx) {
      for (long dy = -1; dy <= 1 && weld[point] == point; ++dy) {
        for (long dz = -1; dz <= 1 && weld[point] == point; ++dz) {
          const auto found = cells.find({center[0] + dx, center[1] + dy, center[2] + dz});
          if (found == cells.end()) continue;
          for (const int other : found->second) {
            if ((model.points_in_world[other] - p).norm() <= tolerance) {
              weld[point] = other;
              break;
            }
          }
        }
      }
    }
    if (weld[point] == point) cells[center].push_back(point);
  }
  return weld;
}

// Points that lie inside the segments between two others: the T-junctions.
class PointsOnSegments {
 public:
  PointsOnSegments(const PolygonModel& model, const std::vector<int>& weld, double tolerance)
      : model_(model), tolerance_(tolerance) {
    for (int point = 0; point < static_cast<int>(weld.size()); ++point) {
      if (weld[point] == point) by_x_.push_back(point);
    }
    std::sort(by_x_.begin(), by_x_.end(), [&](int a, int b) {
      return X(a) != X(b) ? X(a) < X(b) : a < b;
    });
  }

  // The points strictly inside the segment, in order from `start` to `end`.
  std::vector<int> Find(int start, int end) const {
    const Eigen::Vector3d a = model_.points_in_world[start];
    const Eigen::Vector3d along = model_.points_in_world[end] - a;
    const double length = along.norm();
    std::vector<std::pair<double, int>> found;
    const double low = std::min(X(start), X(end)) - tolerance_;
    const double high = std::max(X(start), X(end)) + tolerance_;
    auto it = std::lower_bound(
        by_x_.begin(), by_x_.end(), low, [&](int point, double x) { return X(point) < x; });
    for (; it != by_x_.end() && X(*it) <= high; ++it) {
      if (*it == start || *it == end) continue;
      const Eigen::Vector3d offset = model_.points_in_world[*it] - a;
      const double t = offset.dot(along) / length;
      if (t <= tolerance_ || t >= length - tolerance_) continue;
      if ((offset - t / length * along).norm() > tolerance_) continue;
      found.emplace_back(t, *it);
    }
    std::sort(found.begin(), found.end());
    std::vector<int> points;
    for (const auto& [t, point] : found) points.push_back(point);
    return points;
  }

 private:
  double X(int point) const { return model_.points_in_world[point].x(); }

  const PolygonModel& model_;
  double tolerance_;
  std::vector<int> by_x_;
};

// A piece of a face's border between two welded points, in the face's direction.
struct BorderPiece {
  int face;
  bool is_forward;  // from the lower welded number to the higher
};

}  // namespace

std::vector<ModelEdge> FindModelEdges(const PolygonModel& model) {
  const double tolerance = WeldTolerance(model);
  const std::vector<int> weld = WeldPoints(model, tolerance);
  const PointsOnSegments points_on_segments(model, weld, tolerance);

  // Collect each border piece under its two ends, remembering the order of first appearance.
  std::map<std::pair<int, int>, std::vector<BorderPiece>> pieces;
  std::vector<std::pair<int, int>> order;
  std::vector<Eigen::Vector3d> normals;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    normals.push_back(ComputeFacePlane(model, face).normal_in_world);
    const std::vector<int>& points = model.faces[face].points;
    for (size_t i = 0; i < points.size(); ++i) {
      const int start = weld[points[i]];
      const int end = weld[points[(i + 1) % points.size()]];
      if (start == end) continue;
      std::vector<int> chain = points_on_segments.Find(start, end);
      chain.insert(chain.begin(), start);
      chain.push_back(end);
      for (size_t k = 0; k + 1 < chain.size(); ++k) {
        const std::pair<int, int> ends = std::minmax(chain[k], chain[k + 1]);
        const auto [place, is_new] = pieces.try_emplace(ends);
        if (is_new) order.push_back(ends);
        std::vector<BorderPiece>& here = place->second;
        // A face that walks a piece both ways crosses a bridge to a hole of its: no border.
        const auto back = std::find_if(here.begin(), here.end(), [&](const BorderPiece& piece) {
          return piece.face == face && piece.is_forward != (chain[k] < chain[k + 1]);
        });
        if (back != here.end()) {
          here.erase(back);
        } else {
          here.push_back({face, chain[k] < chain[k + 1]});
        }
      }
    }
  }

  std::vector<ModelEdge> edges;
  for (const std::pair<int, int>& ends : order) {
    const std::vector<BorderPiece>& here = pieces[ends];
    if (here.empty()) continue;
    ModelEdge edge;
    edge.start_in_world = model.points_in_world[ends.first];
    edge.end_in_world = model.points_in_world[ends.second];
    edge.first_face = here[0].face;
    // Where more than two faces meet, the sharpest pair speaks for the line.
    for (size_t i = 1; i < here.size(); ++i) {
      const double side = here[i].is_forward != here[0].is_forward ? 1 : -1;
      const double cosine = side * normals[here[0].face].dot(normals[here[i].face]);
      const double angle_deg = DegreesFromRadians(std::acos(std::clamp(cosine, -1.0, 1.0)));
      if (edge.second_face >= 0 && angle_deg <= edge.angle_deg) continue;
      edge.second_face = here[i].face;
      edge.angle_deg = angle_deg;
      // 0.1 degrees: measured plans are not flatter than that.
      edge.kind = angle_deg < 0.1 ? ModelEdge::Kind::kCoplanar : ModelEdge::Kind::kCrease;
    }
    edges.push_back(edge);
  }
  return edges;
}

}  // namespace groundglass
