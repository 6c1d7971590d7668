// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/check_option.h"
#include "scene/feature_edges.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace groundglass {
namespace {

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

// A part of an edge inside the frame, and how far apart its ends are in the picture.
struct ClippedEdge {
  Eigen::Vector3d a;  // in the view's own axes
  Eigen::Vector3d b;
  double length_px = 0;
};

// The rays of a camera meet in its position.
class CentralRays {
 public:
  CentralRays(const Camera& camera, const Visibility& visibility, double margin_px)
      : camera_(camera),
        visibility_(visibility),
        tolerance_(visibility.DefaultTolerance()),
        position_(camera.PositionInWorld()),
        world_from_cam_(Inverse(camera.cam_from_world)),
        frame_(camera, margin_px) {}

  bool SeesFrontOf(const FacePlane& plane, const Eigen::Vector3d& on_face) const {
    return plane.normal_in_world.dot(position_ - on_face) > 0;
  }
  std::optional<ClippedEdge> Clip(const ModelEdge& edge) const {
    ClippedEdge clipped = {camera_.cam_from_world * edge.start_in_world,
                           camera_.cam_from_world * edge.end_in_world};
    if (!ClipToFrame(frame_, tolerance_, clipped.a, clipped.b)) return std::nullopt;
    const Eigen::Vector3d& a = clipped.a;
    const Eigen::Vector3d& b = clipped.b;
    const Eigen::Vector2d a_px(camera_.focal_x_px * a.x() / a.z(),
                               camera_.focal_y_px * a.y() / a.z());
    const Eigen::Vector2d b_px(camera_.focal_x_px * b.x() / b.z(),
                               camera_.focal_y_px * b.y() / b.z());
    clipped.length_px = (b_px - a_px).norm();
    return clipped;
  }
  // s runs evenly in the image, so the point between a and b divides by depth.
  Eigen::Vector3d PointAt(const ClippedEdge& edge, double s) const {
    const double t = s * edge.a.z() / (edge.b.z() + s * (edge.a.z() - edge.b.z()));
    return world_from_cam_ * Eigen::Vector3d(edge.a + t * (edge.b - edge.a));
  }
  bool IsClear(const Eigen::Vector3d& point_in_world) const {
    return visibility_.IsClear(position_, point_in_world, 3 * tolerance_);
  }

 private:
  const Camera& camera_;
  const Visibility& visibility_;
  double tolerance_;
  Eigen::Vector3d position_;
  RigidTransform world_from_cam_;
  NormalisedFrame frame_;
};

// Those of an elevation are parallel.
class ParallelRays {
 public:
  ParallelRays(const OrthographicView& view,
               const Visibility& visibility,
               const Box& bounds,
               double margin_px)
      : view_(view),
        visibility_(visibility),
        forward_(view.ForwardInWorld()),
        nearest_depth_(std::max(view.near_depth, NearestDepth(view, bounds))) {
    bounds_px_.extend(Eigen::Vector3d(-margin_px, -margin_px, view.near_depth));
    bounds_px_.extend(
        Eigen::Vector3d(view.width_px + margin_px, view.height_px + margin_px, view.far_depth));
  }

  bool SeesFrontOf(const FacePlane& plane, const Eigen::Vector3d&) const {
    return plane.normal_in_world.dot(forward_) < -1e-9;
  }
  std::optional<ClippedEdge> Clip(const ModelEdge& edge) const {
    const Eigen::Vector3d a = view_.FromWorld(edge.start_in_world);
    const Eigen::Vector3d along = view_.FromWorld(edge.end_in_world) - a;
    double t0 = 0;
    double t1 = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double to_min = bounds_px_.min()[axis] - a[axis];
      const double to_max = bounds_px_.max()[axis] - a[axis];
      if (along[axis] == 0) {
        if (to_min > 0 || to_max < 0) return std::nullopt;
        continue;
      }
      const double at_min = to_min / along[axis];
      const double at_max = to_max / along[axis];
      t0 = std::max(t0, std::min(at_min, at_max));
      t1 = std::min(t1, std::max(at_min, at_max));
    }
    if (!(t0 < t1)) return std::nullopt;
    ClippedEdge clipped = {a + t0 * along, a + t1 * along};
    clipped.length_px = (clipped.b - clipped.a).head<2>().norm();
    return clipped;
  }
  Eigen::Vector3d PointAt(const ClippedEdge& edge, double s) const {
    const Eigen::Vector3d point = edge.a + s * (edge.b - edge.a);
    return view_.ToWorld(point.head<2>(), point.z());
  }
  bool IsClear(const Eigen::Vector3d& point_in_world) const {
    const double depth = view_.FromWorld(point_in_world).z();
    return visibility_.IsClear(point_in_world + (nearest_depth_ - depth) * forward_,
                               point_in_world,
                               3 * visibility_.DefaultTolerance());
  }

 private:
  // Before all of the model.
  static double NearestDepth(const OrthographicView& view, const Box& bounds) {
    return view.FromWorld(bounds.Center()).z() - bounds.Diagonal();
  }

  const OrthographicView& view_;
  const Visibility& visibility_;
  Eigen::Vector3d forward_;
  double nearest_depth_;
  Eigen::AlignedBox3d bounds_px_;  // and depth
};

}  // namespace

void FeatureEdgeOptions::Check() const {
  CheckFromTo(min_crease_deg, 0, 180, "feature edge options: min_crease_deg");
}

namespace {

template <typename Rays>
std::vector<VisibleSpan> FindSpans(const PolygonModel& model,
                                   const std::vector<ModelEdge>& edges,
                                   const Rays& rays,
                                   double tolerance,
                                   const FeatureEdgeOptions& options) {
  options.Check();
  // Visibility is asked about every this many pixels; a change in between is found by bisection.
  constexpr double kStepPx = 6;
  constexpr int kBisections = 6;

  std::vector<FacePlane> planes;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    planes.push_back(ComputeFacePlane(model, face));
  }
  const auto sees_front_of = [&](int face) {
    return rays.SeesFrontOf(planes[face], model.points_in_world[model.faces[face].points[0]]);
  };

  std::vector<VisibleSpan> spans;
  for (int index = 0; index < static_cast<int>(edges.size()); ++index) {
    const ModelEdge& edge = edges[index];
    const bool first_front = sees_front_of(edge.first_face);
    const bool is_boundary = edge.second_face < 0;
    const bool second_front = !is_boundary && sees_front_of(edge.second_face);
    if (!is_boundary && !first_front && !second_front) continue;
    const bool is_silhouette = is_boundary || first_front != second_front;
    if (!is_silhouette) {
      if (edge.kind == ModelEdge::Kind::kCoplanar && !options.coplanar_borders) continue;
      if (edge.kind == ModelEdge::Kind::kCrease && edge.angle_deg < options.min_crease_deg) {
        continue;
      }
    }

    const std::optional<ClippedEdge> clipped = rays.Clip(edge);
    if (!clipped || clipped->length_px < 0.5) continue;
    const double length_px = clipped->length_px;

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
    const auto point_at = [&](double s) { return rays.PointAt(*clipped, s); };
    const auto is_visible = [&](double s) { return rays.IsClear(point_at(s) + off); };
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

}  // namespace

std::vector<VisibleSpan> FindVisibleSpans(const PolygonModel& model,
                                          const std::vector<ModelEdge>& edges,
                                          const Visibility& visibility,
                                          const Camera& camera,
                                          double margin_px,
                                          const FeatureEdgeOptions& options) {
  const CentralRays rays(camera, visibility, margin_px);
  return FindSpans(model, edges, rays, visibility.DefaultTolerance(), options);
}

std::vector<VisibleSpan> FindVisibleSpans(const PolygonModel& model,
                                          const std::vector<ModelEdge>& edges,
                                          const Visibility& visibility,
                                          const OrthographicView& view,
                                          double margin_px,
                                          const FeatureEdgeOptions& options) {
  const ParallelRays rays(view, visibility, ComputeBounds(model), margin_px);
  return FindSpans(model, edges, rays, visibility.DefaultTolerance(), options);
}

}  // namespace groundglass
