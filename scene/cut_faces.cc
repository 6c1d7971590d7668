// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/cut_faces.h"

#include "scene/face_outline.h"

#include <polyclipping/clipper.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace groundglass {
namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

// Places in the plane are counted in this share of the face's size, and corners nearer to each
// other, or to a side, than so many of these are the same, or lie on it.
constexpr double kUnitShare = 1e-9;
constexpr double kSamePlaceUnits = 1000;

class OutlineCutter {
 public:
  OutlineCutter(int face, PolygonModel& model)
      : face_(face), model_(model), plane_(ComputeFacePlane(model, face)) {
    origin_ = Point(model.faces[face].points[0]);
    u_ = plane_.normal_in_world.unitOrthogonal();
    v_ = plane_.normal_in_world.cross(u_);
    double size = 0;
    for (const int point : model.faces[face].points) {
      size = std::max(size, (Point(point) - origin_).norm());
    }
    unit_ = kUnitShare * size;
  }

  std::optional<std::vector<int>> Cut(const std::vector<int>& within) {
    if (!(unit_ > 0)) return std::nullopt;
    Paths outer = LoopsOf(face_);
    Paths holes;
    for (const int face : within) {
      for (Path& loop : LoopsOf(face)) {
        MeetAt(loop, outer);
        MeetAt(loop, holes);
        holes.push_back(std::move(loop));
      }
    }
    const Paths whole_holes = holes;
    for (Path& hole : holes) AddCornersOf(whole_holes, hole);
    for (Path& loop : outer) AddCornersOf(whole_holes, loop);
    ClipperLib::Clipper clipper;
    clipper.StrictlySimple(true);
    clipper.AddPaths(outer, ClipperLib::ptSubject, true);
    clipper.AddPaths(holes, ClipperLib::ptClip, true);
    Paths left;
    // Loops of a face run so that its area lies on their left, holes the other way: what any of
    // them covers has a positive winding.
    if (!clipper.Execute(
            ClipperLib::ctDifference, left, ClipperLib::pftPositive, ClipperLib::pftPositive)) {
      return std::nullopt;
    }
    // What is narrower than corners are told apart by is rounding.
    std::erase_if(left, [](const Path& loop) {
      double length = 0;
      for (size_t i = 0; i < loop.size(); ++i) {
        const IntPoint& a = loop[i];
        const IntPoint& b = loop[(i + 1) % loop.size()];
        length += std::hypot(static_cast<double>(b.X - a.X), static_cast<double>(b.Y - a.Y));
      }
      return std::abs(ClipperLib::Area(loop)) <= kSamePlaceUnits * length;
    });
    return Join(left);
  }

 private:
  const Eigen::Vector3d& Point(int index) const { return model_.points_in_world[index]; }

  IntPoint PlaceOf(int point) {
    const Eigen::Vector3d offset = Point(point) - origin_;
    const IntPoint place(std::llround(u_.dot(offset) / unit_),
                         std::llround(v_.dot(offset) / unit_));
    point_at_.emplace(std::pair(place.X, place.Y), point);
    return place;
  }

  // The loops that bound a face, its area on their left.
  Paths LoopsOf(int face) {
    const std::vector<int>& points = model_.faces[face].points;
    std::vector<Eigen::Vector2d> outline;
    for (const int point : points) {
      const IntPoint place = PlaceOf(point);
      outline.emplace_back(static_cast<double>(place.X), static_cast<double>(place.Y));
    }
    const OutlineLoops parted = PartOutline(outline, kSamePlaceUnits, false);
    Paths loops;
    for (const OutlineLoops::Loop& loop : parted.loops) {
      Path& path = loops.emplace_back();
      for (const int corner : loop.corners) path.push_back(PlaceOf(points[corner]));
    }
    return loops;
  }

  static double Distance(const IntPoint& a, const IntPoint& b) {
    return std::hypot(static_cast<double>(b.X - a.X), static_cast<double>(b.Y - a.Y));
  }

  // Corners that are at the same place as one of the other loops become that one.
  static void MeetAt(Path& loop, const Paths& others) {
    for (IntPoint& corner : loop) {
      for (const Path& other : others) {
        for (const IntPoint& its : other) {
          if (Distance(corner, its) <= kSamePlaceUnits) corner = its;
        }
      }
    }
  }

  // Corners of others that lie on a side of the loop become corners of it.
  static void AddCornersOf(const Paths& others, Path& loop) {
    Path added;
    for (size_t i = 0; i < loop.size(); ++i) {
      const IntPoint& a = loop[i];
      const IntPoint& b = loop[(i + 1) % loop.size()];
      added.push_back(a);
      const double length = Distance(a, b);
      std::vector<std::pair<double, IntPoint>> on_side;
      for (const Path& other : others) {
        for (const IntPoint& corner : other) {
          const double along = Distance(a, corner);
          if (corner == a || corner == b || along >= length) continue;
          const double across =
              std::abs(static_cast<double>(b.X - a.X) * static_cast<double>(corner.Y - a.Y) -
                       static_cast<double>(b.Y - a.Y) * static_cast<double>(corner.X - a.X)) /
              length;
          const bool is_ahead =
              static_cast<double>(b.X - a.X) * static_cast<double>(corner.X - a.X) +
                  static_cast<double>(b.Y - a.Y) * static_cast<double>(corner.Y - a.Y) >
              0;
          if (across <= kSamePlaceUnits && is_ahead) on_side.emplace_back(along, corner);
        }
      }
      std::sort(on_side.begin(), on_side.end(), [](const auto& p, const auto& q) {
        return p.first < q.first;
      });
      for (const auto& [along, corner] : on_side) {
        if (!(added.back() == corner)) added.push_back(corner);
      }
    }
    loop = std::move(added);
  }

  // One outline for all loops; nothing if they are several pieces.
  std::optional<std::vector<int>> Join(const Paths& loops) {
    std::vector<Eigen::Vector2d> outline;
    std::vector<IntPoint> places;
    OutlineLoops parted;
    int outer = -1;
    for (const Path& loop : loops) {
      OutlineLoops::Loop& next = parted.loops.emplace_back();
      if (ClipperLib::Orientation(loop)) {
        if (outer >= 0) return std::nullopt;
        outer = static_cast<int>(parted.loops.size()) - 1;
      }
      for (const IntPoint& place : loop) {
        next.corners.push_back(static_cast<int>(places.size()));
        places.push_back(place);
        outline.emplace_back(static_cast<double>(place.X), static_cast<double>(place.Y));
      }
    }
    if (outer < 0) return std::nullopt;
    for (size_t i = 0; i < parted.loops.size(); ++i) {
      if (static_cast<int>(i) != outer) parted.loops[i].inside_of = outer;
    }
    const std::vector<std::vector<int>> joined = BridgeHoles(outline, parted);
    if (joined.size() != 1) return std::nullopt;
    std::vector<int> points;
    for (const int corner : joined[0]) points.push_back(PointAt(places[corner]));
    return points;
  }

  int PointAt(const IntPoint& place) {
    const auto [found, is_new] = point_at_.emplace(std::pair(place.X, place.Y),
                                                   static_cast<int>(model_.points_in_world.size()));
    if (is_new) {
      model_.points_in_world.push_back(origin_ + unit_ * (static_cast<double>(place.X) * u_ +
                                                          static_cast<double>(place.Y) * v_));
    }
    return found->second;
  }

  int face_;
  PolygonModel& model_;
  FacePlane plane_;
  Eigen::Vector3d origin_;
  Eigen::Vector3d u_;
  Eigen::Vector3d v_;
  double unit_ = 0;
  std::map<std::pair<ClipperLib::cInt, ClipperLib::cInt>, int> point_at_;
};

}  // namespace

std::optional<std::vector<int>> CutOutline(int face,
                                           const std::vector<int>& within,
                                           PolygonModel& model) {
  return OutlineCutter(face, model).Cut(within);
}

}  // namespace groundglass
