// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/synthetic_world.h"

#include "datasets-synthetic/noise.h"
#include "scene/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace groundglass {
namespace {

// Corners that round to the same multiple of this (feet) are one point.
constexpr double kSamePoint = 1e-4;

}  // namespace

double SyntheticWorld::SkyLeftAt(const Eigen::Vector2d& ground) const {
  double left = 1;
  for (const ContactShadow& shadow : contact_shadows) {
    const Eigen::Vector2d offset = ground - shadow.center;
    const Eigen::Vector2d across(-shadow.along.y(), shadow.along.x());
    const Eigen::Vector2d beyond(std::abs(offset.dot(shadow.along)) - shadow.half_length,
                                 std::abs(offset.dot(across)) - shadow.half_width);
    const double t = std::min(1.0, beyond.cwiseMax(0).norm() / shadow.reach);
    left *= 1 - shadow.strength * (1 - t * t * (3 - 2 * t));
  }
  return left;
}

PolygonModel SyntheticWorld::Model() const {
  PolygonModel model;
  model.unit = geometry.unit;
  model.georeference = geometry.georeference;
  std::vector<int> new_index(geometry.points_in_world.size(), -1);
  for (int face = 0; face < num_model_faces; ++face) {
    Face copy;
    copy.name = geometry.faces[face].name;
    for (const int point : geometry.faces[face].points) {
      if (new_index[point] < 0) {
        new_index[point] = static_cast<int>(model.points_in_world.size());
        model.points_in_world.push_back(geometry.points_in_world[point]);
      }
      copy.points.push_back(new_index[point]);
    }
    model.faces.push_back(copy);
  }
  return model;
}

int WorldBuilder::PointIndex(const Eigen::Vector3d& point_in_world) {
  std::array<int64_t, 3> place;
  for (int axis = 0; axis < 3; ++axis) {
    place[axis] = std::llround(point_in_world[axis] / kSamePoint);
  }
  std::vector<Eigen::Vector3d>& points = world_.geometry.points_in_world;
  const auto [entry, is_new] = point_of_place_.emplace(place, static_cast<int>(points.size()));
  if (is_new) points.push_back(point_in_world);
  return entry->second;
}

int WorldBuilder::AddPolygon(const std::vector<Eigen::Vector3d>& corners_in_world,
                             Material material,
                             const Rgb& color,
                             const std::string& name,
                             int mask_code) {
  Face face;
  face.name = name;
  for (const Eigen::Vector3d& corner : corners_in_world) face.points.push_back(PointIndex(corner));
  world_.geometry.faces.push_back(face);
  const int index = static_cast<int>(world_.geometry.faces.size()) - 1;

  Surface surface;
  surface.material = material;
  surface.color = color;
  surface.seed = SeedFor(seed_, name, index);
  surface.mask_code = mask_code;
  const Eigen::Vector3d normal = ComputeFacePlane(world_.geometry, index).normal_in_world;
  if (std::abs(normal.z()) > 0.999) {
    surface.axis_u = Eigen::Vector3d::UnitX();
    surface.axis_v = Eigen::Vector3d::UnitY();
  } else {
    surface.axis_u = Eigen::Vector3d::UnitZ().cross(normal).normalized();
    surface.axis_v = normal.cross(surface.axis_u);
  }
  surface.low_u = surface.low_v = std::numeric_limits<double>::infinity();
  surface.high_u = surface.high_v = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& corner : corners_in_world) {
    const Eigen::Vector2d texture = surface.TextureOf(corner);
    surface.low_u = std::min(surface.low_u, texture.x());
    surface.high_u = std::max(surface.high_u, texture.x());
    surface.low_v = std::min(surface.low_v, texture.y());
    surface.high_v = std::max(surface.high_v, texture.y());
  }
  surface.coping_v = surface.high_v;
  world_.surfaces.push_back(surface);
  return index;
}

void WorldBuilder::AddWall(const Eigen::Vector2d& from_in_world,
                           const Eigen::Vector2d& to_in_world,
                           const std::vector<Band>& bands,
                           const std::string& name) {
  for (const Band& band : bands) {
    AddPolygon({{from_in_world.x(), from_in_world.y(), band.low},
                {to_in_world.x(), to_in_world.y(), band.low},
                {to_in_world.x(), to_in_world.y(), band.high},
                {from_in_world.x(), from_in_world.y(), band.high}},
               band.material,
               band.color,
               band.name.empty() ? name : name + " " + band.name);
  }
}

void WorldBuilder::AddBox(const Eigen::Vector3d& low,
                          const Eigen::Vector3d& high,
                          Material side,
                          Material top,
                          const Rgb& color,
                          const std::string& name,
                          int mask_code) {
  const double x[2] = {low.x(), high.x()};
  const double y[2] = {low.y(), high.y()};
  const double z0 = low.z();
  const double z1 = high.z();
  const auto wall = [&](double ax, double ay, double bx, double by, const char* suffix) {
    AddPolygon({{ax, ay, z0}, {bx, by, z0}, {bx, by, z1}, {ax, ay, z1}},
               side,
               color,
               name + suffix,
               mask_code);
  };
  wall(x[0], y[0], x[1], y[0], " south");
  wall(x[1], y[0], x[1], y[1], " east");
  wall(x[1], y[1], x[0], y[1], " north");
  wall(x[0], y[1], x[0], y[0], " west");
  AddPolygon({{x[0], y[0], z1}, {x[1], y[0], z1}, {x[1], y[1], z1}, {x[0], y[1], z1}},
             top,
             color,
             name + " top",
             mask_code);
}

void WorldBuilder::AddTaperedColumn(const Eigen::Vector3d& base,
                                    const Eigen::Vector3d& top,
                                    double base_radius,
                                    double top_radius,
                                    int num_sides,
                                    Material material,
                                    const Rgb& color,
                                    const std::string& name,
                                    int mask_code) {
  const Eigen::Vector3d axis = (top - base).normalized();
  const Eigen::Vector3d across = axis.unitOrthogonal();
  const Eigen::Vector3d other = axis.cross(across);
  const auto rim = [&](int i) -> Eigen::Vector3d {
    const double angle = 2 * std::numbers::pi * i / num_sides;
    return std::cos(angle) * across + std::sin(angle) * other;
  };
  for (int i = 0; i < num_sides; ++i) {
    const Eigen::Vector3d a = rim(i);
    const Eigen::Vector3d b = rim((i + 1) % num_sides);
    AddPolygon({base + base_radius * a,
                base + base_radius * b,
                top + top_radius * b,
                top + top_radius * a},
               material,
               color,
               name,
               mask_code);
  }
}

void WorldBuilder::JoinWall(const std::vector<int>& faces) {
  if (faces.empty()) return;
  double coping_v = -std::numeric_limits<double>::infinity();
  for (const int face : faces) coping_v = std::max(coping_v, world_.surfaces[face].high_v);
  for (const int face : faces) {
    world_.surfaces[face].coping_v = coping_v;
    world_.surfaces[face].seed = world_.surfaces[faces.front()].seed;
  }
}

void WorldBuilder::ShiftTexture(int face, double shift_u) {
  Surface& surface = world_.surfaces[face];
  surface.offset_u += shift_u;
  surface.low_u += shift_u;
  surface.high_u += shift_u;
}

int WorldBuilder::FaceNamed(const std::string& name) const {
  for (size_t face = 0; face < world_.geometry.faces.size(); ++face) {
    if (world_.geometry.faces[face].name == name) return static_cast<int>(face);
  }
  throw Error("the synthetic building has no face named " + name);
}

}  // namespace groundglass
