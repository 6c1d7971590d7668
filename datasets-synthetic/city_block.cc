// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/noise.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

constexpr double kFloor = 12;    // feet from floor to floor
constexpr double kSill = 3.5;    // of a window above its floor
constexpr double kWindow = 5.5;  // a window's height
constexpr double kMinBay = 5.5;
constexpr double kWindowWidth = 5;  // one pane of the glazing's texture

struct Building {
  Eigen::Vector2d low, high;
  int num_floors = 4;
  Material material = Material::kBrick;
  Rgb color = Rgb(0.3f, 0.12f, 0.08f);
  std::string name;
};

std::vector<Building> PlanBuildings(uint64_t seed) {
  const Material materials[4] = {
      Material::kBrick, Material::kStone, Material::kConcrete, Material::kTile};
  const Rgb colors[4] = {
      {0.28f, 0.11f, 0.07f}, {0.4f, 0.36f, 0.28f}, {0.38f, 0.37f, 0.35f}, {0.66f, 0.66f, 0.64f}};
  std::vector<Building> buildings;
  for (int row = 0; row < 2; ++row) {
    double x = 0;
    for (int column = 0; column < 3; ++column) {
      const int index = 3 * row + column;
      const auto draw = [&](const char* what) { return UniformOf(SeedFor(seed, what, index)); };
      Building building;
      const double width = 5 * std::round(12 + 5 * draw("width"));
      const double depth = 5 * std::round(10 + 3 * draw("depth"));
      // The first row's backs look at the second row's over a yard.
      building.low = {x, row == 0 ? 0 : 175 - depth};
      building.high = {x + width, row == 0 ? depth : 175};
      building.num_floors = 3 + static_cast<int>(5 * draw("floors"));
      const int kind = (index + static_cast<int>(4 * draw("kind"))) % 4;
      building.material = materials[kind];
      building.color = colors[kind] * static_cast<float>(0.85 + 0.3 * draw("shade"));
      building.name = "house " + std::to_string(index + 1);
      buildings.push_back(building);
      x += width + 15;
    }
  }
  return buildings;
}

// A wall whose windows are faces of their own, `bay` feet apart, on every floor.
void AddWallWithWindows(WorldBuilder& builder,
                        const Building& building,
                        const Eigen::Vector2d& from,
                        const Eigen::Vector2d& to,
                        double bay,
                        const std::string& name) {
  const double length = (to - from).norm();
  const Eigen::Vector2d along = (to - from) / length;
  const int num_windows = std::max(1, static_cast<int>(length / bay));
  const double pitch = length / num_windows;
  std::vector<int> wall_faces;
  const auto piece = [&](double start, double end, double low, double high, bool is_window) {
    const Eigen::Vector2d a = from + start * along;
    const Eigen::Vector2d b = from + end * along;
    const int face = builder.AddPolygon(
        {{a.x(), a.y(), low}, {b.x(), b.y(), low}, {b.x(), b.y(), high}, {a.x(), a.y(), high}},
        is_window ? Material::kWindowBand : building.material,
        is_window ? Rgb(0.3f, 0.3f, 0.28f) : building.color,
        name + (is_window ? " window" : " wall"));
    // The pane's frame follows the window's own borders.
    if (is_window) {
      builder.ShiftTexture(face, -builder.SurfaceOf(face).low_u);
    } else {
      wall_faces.push_back(face);
    }
  };
  double bottom = 0;
  for (int floor = 0; floor < building.num_floors; ++floor) {
    const double sill = floor * kFloor + kSill;
    piece(0, length, bottom, sill, false);
    double start = 0;
    for (int i = 0; i < num_windows; ++i) {
      const double left = (i + 0.5) * pitch - kWindowWidth / 2;
      piece(start, left, sill, sill + kWindow, false);
      piece(left, left + kWindowWidth, sill, sill + kWindow, true);
      start = left + kWindowWidth;
    }
    piece(start, length, sill, sill + kWindow, false);
    bottom = sill + kWindow;
  }
  piece(0, length, bottom, building.num_floors * kFloor + 3, false);
  builder.JoinWall(wall_faces);
}

void AddBuilding(WorldBuilder& builder, const Building& building, double bay) {
  const Eigen::Vector2d corners[4] = {building.low,
                                      {building.high.x(), building.low.y()},
                                      building.high,
                                      {building.low.x(), building.high.y()}};
  const char* sides[4] = {" south", " east", " north", " west"};
  for (int side = 0; side < 4; ++side) {
    AddWallWithWindows(builder,
                       building,
                       corners[side],
                       corners[(side + 1) % 4],
                       bay,
                       building.name + sides[side]);
  }
  const double height = building.num_floors * kFloor + 3;
  std::vector<Eigen::Vector3d> roof;
  for (const Eigen::Vector2d& corner : corners) roof.push_back({corner.x(), corner.y(), height});
  builder.AddPolygon(roof, Material::kRoof, Rgb(0.3f, 0.29f, 0.27f), building.name + " roof");
  const Eigen::Vector2d middle = (building.low + building.high) / 2;
  builder.AddBox({middle.x() - 8, middle.y() - 6, height},
                 {middle.x() + 8, middle.y() + 6, height + 9},
                 Material::kConcrete,
                 Material::kRoof,
                 Rgb(0.35f, 0.34f, 0.33f),
                 building.name + " lift house");
}

// Widest bay whose number of faces reaches the number asked for; storeys are added where even the
// narrowest does not.
double ChooseBay(std::vector<Building>& buildings, int num_faces) {
  const auto count_faces = [&](double bay) {
    int count = 0;
    for (const Building& building : buildings) {
      const Eigen::Vector2d size = building.high - building.low;
      for (const double length : {size.x(), size.y()}) {
        const int num_windows = std::max(1, static_cast<int>(length / bay));
        count += 2 * (building.num_floors * (2 * num_windows + 2) + 1);
      }
      count += 6;
    }
    return count;
  };
  while (count_faces(kMinBay) < num_faces) {
    for (Building& building : buildings) ++building.num_floors;
  }
  double bay = 100;
  while (bay > kMinBay && count_faces(bay) < num_faces) bay -= 0.25;
  return bay;
}

}  // namespace

Subject MakeCityBlock(uint64_t seed, int num_faces) {
  Subject subject;
  WorldBuilder builder(subject.world, SeedFor(seed, "cityblock"));
  std::vector<Building> buildings = PlanBuildings(seed);
  const double bay = ChooseBay(buildings, num_faces);
  for (const Building& building : buildings) AddBuilding(builder, building, bay);
  subject.world.num_model_faces = static_cast<int>(subject.world.geometry.faces.size());
  const Box bounds = ComputeBounds(subject.world.geometry);
  const double reach = (bounds.max - bounds.min).head<2>().maxCoeff() / 2;
  const double height = bounds.max.z();
  const double distance = std::max(110.0, 1.6 * height);
  // Whoever photographs stands before the distant blocks, which begin 330 ft beyond the plaza.
  const double plaza = reach + std::max(60.0, 1.3 * distance - 250);
  AddSurroundings(builder, bounds.Center().head<2>(), plaza, seed);
  subject.views = MakeRingOfViews(bounds, 16, distance, 5, 5, "s", 1);
  for (const PlannedView& view :
       MakeRingOfViews(bounds, 6, 1.3 * distance, 20, 1.25 * height, "s", 17)) {
    subject.views.push_back(view);
  }
  subject.novel_views = MakeRingOfViews(bounds, 3, 1.05 * distance, 47, 6, "n", 1);
  return subject;
}

}  // namespace groundglass
