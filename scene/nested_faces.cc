// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/nested_faces.h"

#include "scene/face_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <unordered_map>
#include <utility>

namespace groundglass {
namespace {

// Planes nearer to each other than this share of the model's size are one.
constexpr double kSamePlaneDistance = 1e-6;
constexpr double kSamePlaneNormal = 1e-5;

using PlaneCell = std::array<int64_t, 4>;  // normal and offset, rounded

struct PlaneCellHash {
  size_t operator()(const PlaneCell& cell) const {
    uint64_t hash = 1469598103934665603u;
    for (const int64_t number : cell) {
      hash = (hash ^ static_cast<uint64_t>(number)) * 1099511628211u;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

// Parts faces by their planes, then compares those only that overlap along one axis.
class NestedFaceFinder {
 public:
  NestedFaceFinder(const PolygonModel& model, const std::vector<int>& faces)
      : model_(model), bounds_(ComputeBounds(model)) {
    tolerance_ = kSamePlaneDistance * bounds_.Diagonal();
    for (const int face : faces) {
      const FacePlane plane = ComputeFacePlane(model, face);
      groups_[CellOf(plane)].emplace_back(face, plane);
    }
  }

  std::vector<NestedFace> Find() {
    if (!(tolerance_ > 0)) return {};
    for (auto& [cell, flats] : groups_) {
      if (flats.size() > 1) FindInPlane(flats);
    }
    std::vector<NestedFace> nested;
    for (const auto& [inner, outer] : pairs_) nested.push_back({inner, outer});
    return nested;
  }

 private:
  struct Flat {
    Flat(int its_face, const FacePlane& its_plane) : face(its_face), plane(its_plane) {}
    int face;
    FacePlane plane;
    std::vector<std::array<Eigen::Vector2d, 2>> sides;  // but for bridges
    double area = 0;
    Eigen::Vector2d low = Eigen::Vector2d::Zero();
    Eigen::Vector2d high = Eigen::Vector2d::Zero();
  };

  // Coarser than the tolerances: pairs are looked at again. Faces of one plane that lie in two
  // cells are missed, which costs a warning and no more.
  PlaneCell CellOf(const FacePlane& plane) const {
    const double offset = plane.offset - plane.normal_in_world.dot(bounds_.Center());
    // Odd shifts keep the planes that models are full of (axes, 45 degrees) off the cells' borders.
    const auto round = [](double value) {
      return static_cast<int64_t>(std::floor(value + 0.2718));
    };
    return {round(plane.normal_in_world.x() * 50),
            round(plane.normal_in_world.y() * 50),
            round(plane.normal_in_world.z() * 50),
            tolerance_ > 0 ? round(offset / (100 * tolerance_)) : 0};
  }

  void FindInPlane(std::vector<Flat>& flats) {
    const Eigen::Vector3d u = flats[0].plane.normal_in_world.unitOrthogonal();
    const Eigen::Vector3d v = flats[0].plane.normal_in_world.cross(u);
    for (Flat& flat : flats) {
      const std::vector<int>& points = model_.faces[flat.face].points;
      const auto place = [&](int corner) {
        const Eigen::Vector3d offset = model_.points_in_world[points[corner]] - bounds_.Center();
        return Eigen::Vector2d(u.dot(offset), v.dot(offset));
      };
      flat.low = flat.high = place(0);
      for (const OutlineSide& side : FindBorders(model_, flat.face)) {
        flat.sides.push_back({place(side.start), place(side.end)});
        flat.low = flat.low.cwiseMin(flat.sides.back()[0]);
        flat.high = flat.high.cwiseMax(flat.sides.back()[0]);
      }
      flat.area = ComputeFaceArea(model_, flat.face);
    }
    std::sort(flats.begin(), flats.end(), [](const Flat& a, const Flat& b) {
      return a.low.x() != b.low.x() ? a.low.x() < b.low.x() : a.face < b.face;
    });
    for (size_t i = 0; i < flats.size(); ++i) {
      for (size_t k = i + 1; k < flats.size() && flats[k].low.x() < flats[i].high.x(); ++k) {
        const bool is_first_smaller = flats[i].area < flats[k].area;
        const Flat& inner = flats[is_first_smaller ? i : k];
        const Flat& outer = flats[is_first_smaller ? k : i];
        if (IsWithin(inner, outer)) pairs_.emplace(inner.face, outer.face);
      }
    }
  }

  // Where a point lies: -1 outside, 0 on the border, 1 inside.
  int PlaceIn(const Flat& flat, const Eigen::Vector2d& point) const {
    bool is_inside = false;
    for (const auto& [a, b] : flat.sides) {
      const Eigen::Vector2d along = b - a;
      const double t = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      if ((a + t * along - point).norm() <= tolerance_) return 0;
      if ((a.y() <= point.y()) == (b.y() <= point.y())) continue;
      if (a.x() + (point.y() - a.y()) / (b.y() - a.y()) * along.x() > point.x()) {
        is_inside = !is_inside;
      }
    }
    return is_inside ? 1 : -1;
  }

  bool IsWithin(const Flat& inner, const Flat& outer) const {
    for (int axis = 0; axis < 2; ++axis) {
      if (inner.low[axis] < outer.low[axis] - tolerance_ ||
          inner.high[axis] > outer.high[axis] + tolerance_) {
        return false;
      }
    }
    const FacePlane& plane = outer.plane;
    if ((inner.plane.normal_in_world - plane.normal_in_world).norm() > kSamePlaneNormal) {
      return false;
    }
    for (const int point : model_.faces[inner.face].points) {
      if (std::abs(plane.normal_in_world.dot(model_.points_in_world[point]) - plane.offset) >
          tolerance_) {
        return false;
      }
    }
    for (const auto& [a, b] : inner.sides) {
      if (PlaceIn(outer, a) < 0 || PlaceIn(outer, (a + b) / 2) < 0) return false;
    }
    // Sides of the one and corners of the other may still cross: the outer face's corners, its
    // holes' too, must not lie within.
    for (const auto& [a, b] : outer.sides) {
      if (PlaceIn(inner, a) > 0 || PlaceIn(inner, (a + b) / 2) > 0) return false;
    }
    // Borders that coincide: a pane that fills a hole, or lies beside.
    for (const auto& [a, b] : inner.sides) {
      const Eigen::Vector2d along = b - a;
      const Eigen::Vector2d step =
          10 * tolerance_ * Eigen::Vector2d(-along.y(), along.x()).normalized();
      if (PlaceIn(outer, (a + b) / 2 + step) < 0) return false;
    }
    return true;
  }

  const PolygonModel& model_;
  Box bounds_;
  double tolerance_ = 0;
  std::unordered_map<PlaneCell, std::vector<Flat>, PlaneCellHash> groups_;
  std::set<std::pair<int, int>> pairs_;  // inner, outer
};

}  // namespace

std::vector<NestedFace> FindNestedFaces(const PolygonModel& model, const std::vector<int>& faces) {
  return NestedFaceFinder(model, faces).Find();
}

}  // namespace groundglass
