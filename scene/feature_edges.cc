// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/feature_edges.h"

#include "scene/check_option.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace groundglass {
namespace {

// Borders that differ by less than this share of the model's size are the same border.
constexpr double kWeldTolerance = 1e-6;

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
  const double tolerance = std::max(1e-12, kWeldTolerance * ComputeBounds(model).Diagonal());
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

namespace {

// Whether a camera position sees a face's front.
bool IsFrontFacing(const PolygonModel& model,
                   const std::vector<FacePlane>& planes,
                   int face,
                   const Eigen::Vector3d& position_in_world) {
  const Eigen::Vector3d& on_face = model.points_in_world[model.faces[face].points[0]];
  return planes[face].normal_in_world.dot(position_in_world - on_face) > 0;
}

// The frame's bounds on undistorted normalised coordinates, widened by a margin.
struct NormalisedFrame {
  Eigen::Vector2d min;
  Eigen::Vector2d max;

  NormalisedFrame(const Camera& camera, double margin_px) {
    min.setConstant(1e30);
    max.setConstant(-1e30);
    constexpr int kSteps = 8;
    for (int i = 0; i <= kSteps; ++i) {
      const double x = -margin_px + (camera.width_px + 2 * margin_px) * i / kSteps;
      const double y = -margin_px + (camera.height_px + 2 * margin_px) * i / kSteps;
      for (const Eigen::Vector2d& border : {Eigen::Vector2d(x, -margin_px),
                                            Eigen::Vector2d(x, camera.height_px + margin_px),
                                            Eigen::Vector2d(-margin_px, y),
                                            Eigen::Vector2d(camera.width_px + margin_px, y)}) {
        const Eigen::Vector2d normalised = UnprojectToCam(camera, border).head<2>();
        min = min.cwiseMin(normalised);
        max = max.cwiseMax(normalised);
      }
    }
  }
};

// Clips a segment in `cam` to the frame's pyramid (Liang and Barsky's method on five planes);
// false if nothing is left.
bool ClipToFrame(const NormalisedFrame& frame,
                 double near_distance,
                 Eigen::Vector3d& a,
                 Eigen::Vector3d& b) {
  double t0 = 0;
  double t1 = 1;
  const auto clip = [&](double value_a, double value_b) {
    if (value_a < 0 && value_b < 0) return false;
    if (value_a < 0) t0 = std::max(t0, value_a / (value_a - value_b));
    if (value_b < 0) t1 = std::min(t1, value_a / (value_a - value_b));
    return t0 < t1;
  };
  const bool left = clip(a.z() - near_distance, b.z() - near_distance) &&
                    clip(a.x() - frame.min.x() * a.z(), b.x() - frame.min.x() * b.z()) &&
                    clip(frame.max.x() * a.z() - a.x(), frame.max.x() * b.z() - b.x()) &&
                    clip(a.y() - frame.min.y() * a.z(), b.y() - frame.min.y() * b.z()) &&
                    clip(frame.max.y() * a.z() - a.y(), frame.max.y() * b.z() - b.y());
  if (!left) return false;
  const Eigen::Vector3d along = b - a;
  b = a + t1 * along;
  a = a + t0 * along;
  return true;
}

}  // namespace

void FeatureEdgeOptions::Check() const {
  CheckFromTo(min_crease_deg, 0, 180, "feature edge options: min_crease_deg");
}

std::vector<VisibleSpan> FindVisibleSpans(const PolygonModel& model,
                                          const std::vector<ModelEdge>& edges,
                                          const Visibility& visibility,
                                          const Camera& camera,
                                          double margin_px,
                                          const FeatureEdgeOptions& options) {
  options.Check();
  // Visibility is asked about every this many pixels; a change in between is found by bisection.
  constexpr double kStepPx = 6;
  constexpr int kBisections = 6;

  std::vector<FacePlane> planes;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    planes.push_back(ComputeFacePlane(model, face));
  }
  const Eigen::Vector3d position = camera.PositionInWorld();
  const RigidTransform world_from_cam = Inverse(camera.cam_from_world);
  const NormalisedFrame frame(camera, margin_px);
  const double tolerance = visibility.DefaultTolerance();

  std::vector<VisibleSpan> spans;
  for (int index = 0; index < static_cast<int>(edges.size()); ++index) {
    const ModelEdge& edge = edges[index];
    const bool first_front = IsFrontFacing(model, planes, edge.first_face, position);
    const bool is_boundary = edge.second_face < 0;
    const bool second_front =
        !is_boundary && IsFrontFacing(model, planes, edge.second_face, position);
    if (!is_boundary && !first_front && !second_front) continue;
    const bool is_silhouette = is_boundary || first_front != second_front;
    if (!is_silhouette) {
      if (edge.kind == ModelEdge::Kind::kCoplanar && !options.coplanar_borders) continue;
      if (edge.kind == ModelEdge::Kind::kCrease && edge.angle_deg < options.min_crease_deg) {
        continue;
      }
    }

    Eigen::Vector3d a = camera.cam_from_world * edge.start_in_world;
    Eigen::Vector3d b = camera.cam_from_world * edge.end_in_world;
    if (!ClipToFrame(frame, tolerance, a, b)) continue;
    const Eigen::Vector2d a_px(camera.focal_x_px * a.x() / a.z(),
                               camera.focal_y_px * a.y() / a.z());
    const Eigen::Vector2d b_px(camera.focal_x_px * b.x() / b.z(),
                               camera.focal_y_px * b.y() / b.z());
    const double length_px = (b_px - a_px).norm();
    if (length_px < 0.5) continue;

    // Step off the surface, so that the faces that meet in the edge do not hide it: outwards along
    // their normals, and a little towards the camera.
    Eigen::Vector3d off = first_front ? planes[edge.first_face].normal_in_world
                                      : Eigen::Vector3d(-planes[edge.first_face].normal_in_world);
    if (!is_boundary) {
      off = planes[edge.first_face].normal_in_world + planes[edge.second_face].normal_in_world;
      // A knife's edge has no outward side: the face that is seen decides.
      if (off.norm() < 0.1) {
        off = planes[first_front ? edge.first_face : edge.second_face].normal_in_world;
      }
    }
    off = off.normalized() * tolerance;
    // s runs evenly in the image, so the point between a and b divides by depth.
    const auto point_at = [&](double s) -> Eigen::Vector3d {
      const double t = s * a.z() / (b.z() + s * (a.z() - b.z()));
      return world_from_cam * Eigen::Vector3d(a + t * (b - a));
    };
    const auto is_visible = [&](double s) {
      return visibility.IsClear(position, point_at(s) + off, 3 * tolerance);
    };
    const int steps = std::max(2, static_cast<int>(std::ceil(length_px / kStepPx)));
    const auto border_between = [&](double seen, double hidden) {
      for (int i = 0; i < kBisections; ++i) {
        const double middle = (seen + hidden) / 2;
        (is_visible(middle) ? seen : hidden) = middle;
      }
      return seen;
    };
    // The very ends touch other faces, so ask just inside them.
    const double inset = std::min(0.25, 0.5 / length_px);
    const auto position_of = [&](int step) {
      return std::clamp(static_cast<double>(step) / steps, inset, 1 - inset);
    };
    bool was_visible = false;
    double start = 0;
    for (int step = 0; step <= steps; ++step) {
      const double s = position_of(step);
      const bool visible = is_visible(s);
      if (visible && !was_visible) start = step == 0 ? 0 : border_between(s, position_of(step - 1));
      if (was_visible && (!visible || step == steps)) {
        const double end = visible ? 1 : border_between(position_of(step - 1), s);
        if ((end - start) * length_px >= 0.5) {
          spans.push_back({index, point_at(start), point_at(end), is_silhouette});
        }
      }
      was_visible = visible;
    }
  }
  return spans;
}

}  // namespace groundglass
