// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/lettering.h"
#include "datasets-synthetic/noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace groundglass {
namespace {

const Rgb kBrickRed(0.33f, 0.12f, 0.075f);
const Rgb kSandstone(0.48f, 0.43f, 0.33f);
const Rgb kSlateGrey(0.13f, 0.14f, 0.16f);
const Rgb kSash(0.5f, 0.5f, 0.46f);

constexpr double kBase = 4;     // top of the stone base
constexpr double kEaves = 26;   // top of the walls
constexpr double kCourse = 15;  // the string course between the storeys

// Stones at the corners of a brick face, none of them in the model.
void AddQuoins(Surface& surface, double high, bool at_left, bool at_right) {
  if (at_left) {
    surface.decals.push_back(MakeDecal(MakeQuoins(surface.low_v, high, true, kSandstone),
                                       surface.low_u,
                                       surface.low_v,
                                       surface.low_u + 2,
                                       high));
  }
  if (at_right) {
    surface.decals.push_back(MakeDecal(MakeQuoins(surface.low_v, high, false, kSandstone),
                                       surface.high_u - 2,
                                       surface.low_v,
                                       surface.high_u,
                                       high));
  }
}

// Which ends of a wall are corners of the building that stand out.
struct Corners {
  bool at_from = false;
  bool at_to = false;
};

// A long wall: stone base, brick with a row of windows, string course, quoins.
void AddLongWall(WorldBuilder& builder,
                 const Eigen::Vector2d& from,
                 const Eigen::Vector2d& to,
                 int num_windows,
                 const Corners& corners,
                 const std::string& name) {
  const double length = (to - from).norm();
  const Eigen::Vector2d along = (to - from) / length;
  std::vector<int> brick_faces;
  const auto piece = [&](double start,
                         double end,
                         double low,
                         double high,
                         Material material,
                         const Rgb& color,
                         const std::string& part) {
    const Eigen::Vector2d a = from + start * along;
    const Eigen::Vector2d b = from + end * along;
    const int face = builder.AddPolygon(
        {{a.x(), a.y(), low}, {b.x(), b.y(), low}, {b.x(), b.y(), high}, {a.x(), a.y(), high}},
        material,
        color,
        name + " " + part);
    if (material == Material::kBrick) {
      brick_faces.push_back(face);
      AddQuoins(builder.SurfaceOf(face),
                high,
                corners.at_from && start == 0,
                corners.at_to && end == length);
    }
    return face;
  };
  piece(0, length, 0, kBase, Material::kStone, kSandstone, "base");
  if (num_windows == 0) {
    piece(0, length, kBase, kEaves, Material::kBrick, kBrickRed, "brick");
    return;
  }
  piece(0, length, kBase, 6, Material::kBrick, kBrickRed, "parapet");
  const double pitch = length / num_windows;
  double start = 0;
  for (int i = 0; i < num_windows; ++i) {
    const double left = (i + 0.5) * pitch - 2.5;
    const std::string number = std::to_string(i + 1);
    piece(start, left, 6, 13, Material::kBrick, kBrickRed, "pier " + number);
    const int window =
        piece(left, left + 5, 6, 13, Material::kWindowBand, kSash, "window " + number);
    builder.ShiftTexture(window, -builder.SurfaceOf(window).low_u);
    start = left + 5;
  }
  piece(
      start, length, 6, 13, Material::kBrick, kBrickRed, "pier " + std::to_string(num_windows + 1));
  piece(0, length, 13, kCourse, Material::kBrick, kBrickRed, "lintels");
  piece(0, length, kCourse, kCourse + 1.5, Material::kStone, kSandstone, "string course");
  piece(0, length, kCourse + 1.5, kEaves, Material::kBrick, kBrickRed, "upper storey");
  builder.JoinWall(brick_faces);
}

// A wall that ends in a gable: stone base and a five-cornered brick face with quoins, a coping and
// a round window.
void AddGable(WorldBuilder& builder,
              const Eigen::Vector2d& from,
              const Eigen::Vector2d& to,
              double ridge,
              const std::string& name) {
  builder.AddWall(from, to, {{0, kBase, Material::kStone, kSandstone, "base"}}, name);
  const Eigen::Vector2d middle = (from + to) / 2;
  const int face = builder.AddPolygon({{from.x(), from.y(), kBase},
                                       {to.x(), to.y(), kBase},
                                       {to.x(), to.y(), kEaves},
                                       {middle.x(), middle.y(), ridge},
                                       {from.x(), from.y(), kEaves}},
                                      Material::kBrick,
                                      kBrickRed,
                                      name + " gable");
  Surface& surface = builder.SurfaceOf(face);
  AddQuoins(surface, kEaves, true, true);
  const double width = surface.high_u - surface.low_u;
  surface.decals.push_back(MakeDecal(
      MakeCoping(width, ridge - kEaves, kSandstone), surface.low_u, kEaves, surface.high_u, ridge));
  const double center = (surface.low_u + surface.high_u) / 2;
  constexpr double kRadius = 2.6;
  const double height = kEaves + 0.42 * (ridge - kEaves);
  surface.decals.push_back(MakeDecal(MakeOculus(kSandstone),
                                     center - kRadius,
                                     height - kRadius,
                                     center + kRadius,
                                     height + kRadius));
}

// One slope of a roof: eaves from a to b (outside on the right), ridge from b's end to a's.
void AddSlope(WorldBuilder& builder,
              const Eigen::Vector2d& a,
              const Eigen::Vector2d& b,
              const Eigen::Vector2d& ridge_b,
              const Eigen::Vector2d& ridge_a,
              double ridge,
              const std::string& name) {
  builder.AddPolygon({{a.x(), a.y(), kEaves},
                      {b.x(), b.y(), kEaves},
                      {ridge_b.x(), ridge_b.y(), ridge},
                      {ridge_a.x(), ridge_a.y(), ridge}},
                     Material::kSlate,
                     kSlateGrey,
                     name);
}

void AddPorch(WorldBuilder& builder, double x, double y) {
  for (const double side : {-6.0, 4.5}) {
    builder.AddBox({x + side, y - 9, 0},
                   {x + side + 1.5, y - 7.5, 11},
                   Material::kStone,
                   Material::kStone,
                   kSandstone,
                   side < 0 ? "porch post west" : "porch post east");
  }
  builder.AddBox({x - 7, y - 10, 11},
                 {x + 7, y, 13},
                 Material::kStone,
                 Material::kSlate,
                 kSandstone,
                 "porch roof");
  builder.AddPolygon({{x - 7, y - 10, 11}, {x - 7, y, 11}, {x + 7, y, 11}, {x + 7, y - 10, 11}},
                     Material::kPlain,
                     kSandstone,
                     "porch ceiling");
}

}  // namespace

Subject MakeBrickHall(uint64_t seed) {
  Subject subject;
  WorldBuilder builder(subject.world, SeedFor(seed, "brick"));
  // The hall runs east and west, 90 by 40 ft; its cross wing, 36 ft wide, comes forward 22 ft to
  // the south. Both ridges are as high, so the roofs meet in two valleys.
  constexpr double kRidge = 42;
  constexpr double kWingRidge = kEaves + 16.0 * 18 / 20;
  AddLongWall(builder, {0, 0}, {36, 0}, 3, {true, false}, "south wall west part");
  AddLongWall(builder, {72, 0}, {90, 0}, 2, {false, true}, "south wall east part");
  AddLongWall(builder, {90, 40}, {0, 40}, 7, {true, true}, "north wall");
  AddGable(builder, {90, 0}, {90, 40}, kRidge, "east end");
  AddGable(builder, {0, 40}, {0, 0}, kRidge, "west end");
  AddLongWall(builder, {36, 0}, {36, -22}, 0, {false, true}, "wing west wall");
  AddGable(builder, {36, -22}, {72, -22}, kWingRidge, "wing front");
  AddLongWall(builder, {72, -22}, {72, 0}, 0, {true, false}, "wing east wall");
  AddSlope(builder, {90, 40}, {0, 40}, {0, 20}, {90, 20}, kRidge, "north roof");
  // The wing's ridge runs into the south slope where that is as high: 18 ft in.
  const Eigen::Vector3d meeting(54, 18, kWingRidge);
  builder.AddPolygon({{0, 0, kEaves},
                      {36, 0, kEaves},
                      meeting,
                      {72, 0, kEaves},
                      {90, 0, kEaves},
                      {90, 20, kRidge},
                      {0, 20, kRidge}},
                     Material::kSlate,
                     kSlateGrey,
                     "south roof");
  builder.AddPolygon({{36, 0, kEaves}, {36, -22, kEaves}, {54, -22, kWingRidge}, meeting},
                     Material::kSlate,
                     kSlateGrey,
                     "wing roof west");
  builder.AddPolygon({{72, -22, kEaves}, {72, 0, kEaves}, meeting, {54, -22, kWingRidge}},
                     Material::kSlate,
                     kSlateGrey,
                     "wing roof east");
  builder.AddBox(
      {14, 22, 30}, {19, 28, 50}, Material::kBrick, Material::kStone, kBrickRed, "chimney");
  AddPorch(builder, 18, 0);
  Surface& front = builder.SurfaceOf(builder.FaceNamed("wing front gable"));
  front.decals.push_back(
      MakeDecal(MakeLettering("READING ROOM", Rgb(0.7f, 0.66f, 0.5f)), 42, 17, 66, 19.4));
  front.decals.push_back(MakeDecal(MakePoster(5), 39, 6, 45, 15));
  subject.world.num_model_faces = static_cast<int>(subject.world.geometry.faces.size());
  const Box bounds = ComputeBounds(subject.world.geometry);
  AddSurroundings(builder, bounds.Center().head<2>(), 115, seed);
  subject.views = MakeRingOfViews(bounds, 12, 75, 15, 5, "s", 1);
  for (const PlannedView& view : MakeRingOfViews(bounds, 4, 85, 40, 34, "s", 13)) {
    subject.views.push_back(view);
  }
  subject.novel_views = MakeRingOfViews(bounds, 3, 72, 268, 6, "n", 1);
  return subject;
}

}  // namespace groundglass
