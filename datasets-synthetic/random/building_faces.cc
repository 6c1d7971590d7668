// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/random/building_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

double CrossOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// The ring's points with its rounded corners as arcs; `sides` says which side leaves each point (-1
// on an arc), `starts` how far along it the point lies.
struct OpenRing {
  std::vector<Eigen::Vector2d> points;
  std::vector<int> sides;
  std::vector<double> starts;
};

OpenRing RingWithArcs(const std::vector<PlanCorner>& plan, bool is_round) {
  const int num_arcs = is_round ? 12 : 3;
  OpenRing ring;
  const auto add = [&](const Eigen::Vector2d& point, int side, double start) {
    ring.points.push_back(point);
    ring.sides.push_back(side);
    ring.starts.push_back(start);
  };
  const size_t n = plan.size();
  for (size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& corner = plan[i].at;
    const double radius = plan[i].radius;
    if (radius == 0) {
      add(corner, static_cast<int>(i), 0);
      continue;
    }
    const Eigen::Vector2d in = (corner - plan[(i + n - 1) % n].at).normalized();
    const Eigen::Vector2d out = (plan[(i + 1) % n].at - corner).normalized();
    const Eigen::Vector2d center = corner - radius * in + radius * out;
    for (int k = 0; k < num_arcs; ++k) {
      const double angle = std::numbers::pi / 2 * k / num_arcs;
      // From the first tangent point, which lies against `out`, to the second, along `in`.
      add(center + radius * (-std::cos(angle) * out + std::sin(angle) * in), -1, 0);
    }
    add(corner + radius * out, static_cast<int>(i), radius);
  }
  return ring;
}

void AddBodyWalls(const Body& body, const BuildingDetail& detail, FaceList& faces) {
  for (const bool of_court : {false, true}) {
    const std::vector<PlanCorner>& plan = of_court ? body.court : body.plan;
    if (plan.empty()) continue;
    for (const WallPiece& wall : WallPiecesOf(body, of_court, detail.has_round_corners)) {
      const std::string place = of_court ? " court wall " : wall.side < 0 ? " corner" : " wall ";
      const std::string number = wall.side < 0 ? "" : std::to_string(wall.side + 1);
      AddWallPiece(body,
                   wall,
                   wall.side < 0 ? std::vector<Opening>() : plan[wall.side].openings,
                   detail,
                   body.name + place + number,
                   faces);
    }
  }
}

bool HasBox(const PlainBox& box, const BuildingDetail& detail) {
  if (box.kind == "chimneys") return detail.has_chimneys;
  return box.kind == "steps" ? detail.has_steps : detail.has_porch;
}

}  // namespace

void FaceList::Add(std::vector<Eigen::Vector3d> corners,
                   const std::string& name,
                   Material material,
                   const Rgb& color,
                   bool is_fine) {
  BuildingFace face;
  face.corners = std::move(corners);
  face.name = name;
  face.material = material;
  face.color = color;
  face.is_fine = is_fine;
  faces_.push_back(std::move(face));
}

void FaceList::AddBox(const Eigen::Vector3d& low,
                      const Eigen::Vector3d& high,
                      const std::string& name,
                      Material material,
                      const Rgb& color,
                      bool is_fine,
                      bool has_underside) {
  const auto at = [&](int x, int y, int z) {
    return Eigen::Vector3d(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
  };
  const auto add = [&](const std::array<Eigen::Vector3d, 4>& corners, const char* side) {
    Add({corners.begin(), corners.end()}, name + side, material, color, is_fine);
  };
  add({at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)}, " front");
  add({at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}, " right");
  add({at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1)}, " back");
  add({at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1)}, " left");
  add({at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}, " top");
  if (has_underside) add({at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)}, " underside");
}

std::vector<WallPiece> WallPiecesOf(const Body& body, bool of_court, bool is_round) {
  const std::vector<PlanCorner>& plan = of_court ? body.court : body.plan;
  const OpenRing ring = RingWithArcs(plan, is_round);
  const size_t n = ring.points.size();
  std::vector<WallPiece> walls;
  const Eigen::Vector2d low = body.Low();
  const Eigen::Vector2d size = body.High() - low;
  for (size_t i = 0; i < n; ++i) {
    WallPiece wall;
    wall.side = ring.sides[i];
    if (wall.side >= 0 && !plan[wall.side].has_wall) continue;
    wall.from = ring.points[i];
    wall.to = ring.points[(i + 1) % n];
    wall.start_s = ring.starts[i];
    wall.low = body.base;
    const Eigen::Vector2d way = wall.to - wall.from;
    const Eigen::Vector2d next = ring.points[(i + 2) % n] - wall.to;
    const Eigen::Vector2d last = wall.from - ring.points[(i + n - 1) % n];
    wall.bends_to = CrossOf(way.normalized(), next.normalized()) > 0.9;
    wall.bends_from = CrossOf(last.normalized(), way.normalized()) > 0.9;
    const double flat = body.eaves + (body.roof == RoofKind::kFlat ? body.parapet : 0);
    const bool runs_along_x = std::abs(way.x()) > std::abs(way.y());
    wall.high_from = wall.high_to = flat;
    if (body.roof == RoofKind::kGabled && runs_along_x != body.is_ridge_along_x) {
      wall.apex = body.ridge;
    }
    if (body.roof == RoofKind::kMono) {
      const int axis = body.is_ridge_along_x ? 1 : 0;
      const auto height = [&](const Eigen::Vector2d& at) {
        return std::lerp(body.eaves, body.ridge, (at[axis] - low[axis]) / size[axis]);
      };
      wall.high_from = height(wall.from);
      wall.high_to = height(wall.to);
    }
    walls.push_back(wall);
  }
  return walls;
}

std::vector<Eigen::Vector2d> RingOf(const Body& body, bool of_court, double inset, bool is_round) {
  const std::vector<PlanCorner>& plan = of_court ? body.court : body.plan;
  const OpenRing ring = RingWithArcs(plan, is_round);
  const size_t n = ring.points.size();
  // Each line moves inwards by its own inset; neighbours meet where both have moved to.
  std::vector<Eigen::Vector2d> points;
  for (size_t i = 0; i < n; ++i) {
    const size_t before = (i + n - 1) % n;
    const auto inset_of = [&](size_t line) {
      return ring.sides[line] >= 0 && !plan[ring.sides[line]].has_wall ? 0 : inset;
    };
    const Eigen::Vector2d in = (ring.points[i] - ring.points[before]).normalized();
    const Eigen::Vector2d out = (ring.points[(i + 1) % n] - ring.points[i]).normalized();
    const Eigen::Vector2d in_normal(-in.y(), in.x());
    const Eigen::Vector2d out_normal(-out.y(), out.x());
    Eigen::Matrix2d normals;
    normals << in_normal.transpose(), out_normal.transpose();
    points.push_back(ring.points[i] +
                     normals.inverse() * Eigen::Vector2d(inset_of(before), inset_of(i)));
  }
  return points;
}

std::vector<BuildingFace> MakeBuildingFaces(const Massing& massing, const BuildingDetail& detail) {
  FaceList faces;
  const Body& main = massing.bodies.front();
  for (const bool neighbours : {false, true}) {
    if (neighbours && !detail.has_neighbours) break;
    const size_t first = faces.Faces().size();
    for (const Body& body : massing.bodies) {
      if (body.is_neighbour != neighbours) continue;
      AddBodyWalls(body, detail, faces);
      AddRoof(body, main, detail, faces);
    }
    for (size_t i = first; i < faces.Faces().size(); ++i)
      faces.Faces()[i].is_neighbour = neighbours;
    if (neighbours) break;
    for (const PlainBox& box : massing.boxes) {
      if (!HasBox(box, detail)) continue;
      faces.AddBox(
          box.low, box.high, box.name, box.material, box.color, false, box.name == "porch roof");
    }
    for (size_t i = 0; i < massing.dormers.size() && detail.has_dormers; ++i) {
      AddDormer(main, massing.dormers[i], "dormer " + std::to_string(i + 1), detail, faces);
    }
  }
  return std::move(faces.Faces());
}

}  // namespace groundglass
