// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/relief.h"

#include "datasets-synthetic/noise.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

int AddPoint(const Eigen::Vector3d& point_in_world, SyntheticWorld& world) {
  world.geometry.points_in_world.push_back(point_in_world);
  return static_cast<int>(world.geometry.points_in_world.size()) - 1;
}

// Adds polygons that belong to the building and not to its model.
class ReliefBuilder {
 public:
  ReliefBuilder(SyntheticWorld& world, const Rgb& color, uint64_t seed)
      : world_(world), builder_(world, seed), color_(color) {}

  void Add(const std::vector<Eigen::Vector3d>& corners_in_world, const std::string& name) {
    const int face = builder_.AddPolygon(corners_in_world, Material::kPlain, color_, name);
    world_.surfaces[face].is_relief = true;
  }

 private:
  SyntheticWorld& world_;
  WorldBuilder builder_;
  Rgb color_;
};

// An upright rectangle in the order of WorldBuilder::AddWall: lower edge from `from` to `to`.
struct Opening {
  Eigen::Vector3d from, to;  // of the lower edge, in the wall's plane
  Eigen::Vector3d along, inward;
  double length = 0;
  double height = 0;

  Eigen::Vector3d At(double s, double depth, double h) const {
    return from + s * along + depth * inward + h * Eigen::Vector3d::UnitZ();
  }
};

bool IsUprightRectangle(const PolygonModel& geometry, int face, Opening& opening) {
  const std::vector<int>& points = geometry.faces[face].points;
  if (points.size() != 4) return false;
  const auto corner = [&](int i) { return geometry.points_in_world[points[i]]; };
  opening.from = corner(0);
  opening.to = corner(1);
  const Eigen::Vector3d edge = opening.to - opening.from;
  opening.height = corner(3).z() - corner(0).z();
  const Eigen::Vector3d up(0, 0, opening.height);
  if (opening.height <= 0 || std::abs(edge.z()) > 1e-6) return false;
  if ((corner(2) - opening.to - up).norm() > 1e-6) return false;
  if ((corner(3) - opening.from - up).norm() > 1e-6) return false;
  opening.length = edge.norm();
  opening.along = edge / opening.length;
  opening.inward = Eigen::Vector3d::UnitZ().cross(opening.along);
  return true;
}

// Pushes a window into its wall. Bands of windows end at posts, so that none breaks through the
// building's corner.
void DeepenWindow(int face, double depth, ReliefBuilder& relief, SyntheticWorld& world) {
  constexpr double kLongestWindow = 12;  // feet; what is longer is a band
  Opening o;
  if (!IsUprightRectangle(world.geometry, face, o)) return;
  const bool is_band = o.length > kLongestWindow;
  const double end = is_band ? 0.3 : 0;
  const double left = end;
  const double right = o.length - end;
  const double top = o.height;
  const std::string name = world.geometry.faces[face].name;

  relief.Add({o.At(left, 0, 0), o.At(right, 0, 0), o.At(right, depth, 0), o.At(left, depth, 0)},
             name + " ledge");
  relief.Add(
      {o.At(left, depth, top), o.At(right, depth, top), o.At(right, 0, top), o.At(left, 0, top)},
      name + " head");
  relief.Add({o.At(left, 0, 0), o.At(left, depth, 0), o.At(left, depth, top), o.At(left, 0, top)},
             name + " reveal 1");
  relief.Add(
      {o.At(right, depth, 0), o.At(right, 0, 0), o.At(right, 0, top), o.At(right, depth, top)},
      name + " reveal 2");
  if (is_band) {
    relief.Add({o.At(0, 0, 0), o.At(left, 0, 0), o.At(left, 0, top), o.At(0, 0, top)},
               name + " post 1");
    relief.Add(
        {o.At(right, 0, 0), o.At(o.length, 0, 0), o.At(o.length, 0, top), o.At(right, 0, top)},
        name + " post 2");
  }
  // The sill, before the wall under the window.
  const double out = is_band ? -0.2 * depth : -0.4 * depth;
  const double low = is_band ? -0.15 : -0.3;
  const double beyond = is_band ? -end : 0.2;
  const double a = left - beyond;
  const double b = right + beyond;
  relief.Add({o.At(a, out, 0), o.At(b, out, 0), o.At(b, 0, 0), o.At(a, 0, 0)}, name + " sill top");
  relief.Add({o.At(a, out, low), o.At(b, out, low), o.At(b, out, 0), o.At(a, out, 0)},
             name + " sill front");
  relief.Add({o.At(a, 0, low), o.At(b, 0, low), o.At(b, out, low), o.At(a, out, low)},
             name + " sill underside");
  relief.Add({o.At(a, 0, low), o.At(a, out, low), o.At(a, out, 0), o.At(a, 0, 0)},
             name + " sill end 1");
  relief.Add({o.At(b, out, low), o.At(b, 0, low), o.At(b, 0, 0), o.At(b, out, 0)},
             name + " sill end 2");

  // The pane keeps its texture coordinates: the wall's axes are square to the way in.
  world.geometry.faces[face].points = {AddPoint(o.At(left, depth, 0), world),
                                       AddPoint(o.At(right, depth, 0), world),
                                       AddPoint(o.At(right, depth, top), world),
                                       AddPoint(o.At(left, depth, top), world)};
  Surface& surface = world.surfaces[face];
  surface.is_relief = true;
  surface.low_u += left;
  surface.high_u -= end;
}

// Lets every face that borders on the edge from `a` to `b` follow the arc between them.
void InsertIntoEdges(int a, int b, const std::vector<int>& arc, SyntheticWorld& world) {
  for (int face = 0; face < world.num_model_faces; ++face) {
    std::vector<int>& points = world.geometry.faces[face].points;
    for (size_t i = 0; i < points.size(); ++i) {
      const int next = points[(i + 1) % points.size()];
      const auto place = points.begin() + static_cast<std::ptrdiff_t>(i) + 1;
      if (points[i] == a && next == b) {
        points.insert(place, arc.begin(), arc.end());
        break;
      }
      if (points[i] == b && next == a) {
        points.insert(place, arc.rbegin(), arc.rend());
        break;
      }
    }
  }
}

// Bends a flat face of a rounded corner to the arc between its two upright edges.
void BendFace(int face, const Eigen::Vector2d& center, SyntheticWorld& world) {
  constexpr int kStrips = 10;
  Opening o;
  if (!IsUprightRectangle(world.geometry, face, o)) return;
  const std::vector<int> flat = world.geometry.faces[face].points;
  const Eigen::Vector2d start = o.from.head<2>() - center;
  const Eigen::Vector2d finish = o.to.head<2>() - center;
  const double radius = start.norm();
  const double sweep =
      std::atan2(start.x() * finish.y() - start.y() * finish.x(), start.dot(finish));
  std::vector<int> low = {flat[0]};
  std::vector<int> high = {flat[3]};
  std::vector<int> arc_high;
  for (int i = 1; i < kStrips; ++i) {
    const double angle = std::atan2(start.y(), start.x()) + sweep * i / kStrips;
    const Eigen::Vector2d place =
        center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    low.push_back(AddPoint({place.x(), place.y(), o.from.z()}, world));
    high.push_back(AddPoint({place.x(), place.y(), o.from.z() + o.height}, world));
    arc_high.push_back(high.back());
  }
  low.push_back(flat[1]);
  high.push_back(flat[2]);
  world.geometry.faces[face].points.clear();
  InsertIntoEdges(flat[3], flat[2], arc_high, world);

  const Surface whole = world.surfaces[face];
  const double piece = (whole.high_u - whole.low_u) / kStrips;
  const std::string name = world.geometry.faces[face].name;
  for (int i = 0; i < kStrips; ++i) {
    Surface strip = whole;
    strip.is_relief = true;
    const Eigen::Vector3d& from = world.geometry.points_in_world[low[i]];
    const Eigen::Vector3d& to = world.geometry.points_in_world[low[i + 1]];
    strip.axis_u = (to - from) * (piece / (to - from).squaredNorm());
    strip.low_u = whole.low_u + i * piece;
    strip.high_u = strip.low_u + piece;
    strip.offset_u = strip.low_u - strip.axis_u.dot(from);
    const std::vector<int> points = {low[i], low[i + 1], high[i + 1], high[i]};
    if (i == 0) {
      world.geometry.faces[face].points = points;
      world.surfaces[face] = strip;
    } else {
      world.geometry.faces.push_back({points, name});
      world.surfaces.push_back(strip);
    }
  }
}

bool IsRectangle(const SyntheticWorld& world, int face) {
  const std::vector<int>& points = world.geometry.faces[face].points;
  const Surface& surface = world.surfaces[face];
  if (points.size() != 4) return false;
  return std::all_of(points.begin(), points.end(), [&](int point) {
    const Eigen::Vector2d at = surface.TextureOf(world.geometry.points_in_world[point]);
    return std::min(at.x() - surface.low_u, surface.high_u - at.x()) < 1e-6 &&
           std::min(at.y() - surface.low_v, surface.high_v - at.y()) < 1e-6;
  });
}

}  // namespace

void AddRelief(double depth, const Rgb& reveal_color, uint64_t seed, SyntheticWorld& world) {
  if (depth == 0) return;
  ReliefBuilder relief(world, reveal_color, SeedFor(seed, "relief"));
  for (int face = 0; face < world.num_model_faces; ++face) {
    if (world.surfaces[face].material != Material::kWindowBand) continue;
    const double chance = UniformOf(SeedFor(seed, "recess", face));
    DeepenWindow(face, depth * (0.3 + 0.3 * chance), relief, world);
  }
  for (const SyntheticWorld::RoundCorner& corner : world.round_corners) {
    for (const int face : corner.faces) BendFace(face, corner.center_in_world, world);
  }
}

void PaintPlainly(uint64_t seed, SyntheticWorld& world) {
  for (int face = 0; face < static_cast<int>(world.surfaces.size()); ++face) {
    Surface& surface = world.surfaces[face];
    surface.material = Material::kEven;
    surface.decals.clear();
    if (face < world.num_model_faces) {
      if (IsRectangle(world, face)) surface.material = Material::kPanel;
      // Multiples of the golden ratio: faces that follow one another, as neighbours do, differ by
      // at least a fifth of white.
      const double turn = face * 0.6180339887;
      const auto grey = static_cast<float>(0.16 + 0.56 * (turn - std::floor(turn)));
      const auto tint = static_cast<float>(0.12 * (UniformOf(SeedFor(seed, "tint", face)) - 0.5));
      surface.color = Rgb(grey * (1 + tint), grey, grey * (1 - tint));
    }
  }
}

}  // namespace groundglass
