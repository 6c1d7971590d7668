// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/buildings.h"
#include "datasets-synthetic/lettering.h"
#include "datasets-synthetic/noise.h"
#include "scene/frames.h"

#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

const Rgb kWhite(0.74f, 0.74f, 0.72f);
const Rgb kFrame(0.2f, 0.2f, 0.21f);
const Rgb kConcreteGrey(0.42f, 0.41f, 0.39f);
const Rgb kGravel(0.33f, 0.32f, 0.3f);

using Band = WorldBuilder::Band;

// Corners are thought of as on a plan in the thesis' frame: x east, y SOUTH.
Eigen::Vector2d OnPlan(double x, double y_south) { return {x, -y_south}; }
Eigen::Vector3d At(double x, double y_south, double z) { return {x, -y_south, z}; }

// The corner points of a quarter circle of three flat faces, from one tangent point to the other.
std::vector<Eigen::Vector2d> RoundedCorner(const Eigen::Vector2d& center,
                                           double radius,
                                           double start_deg) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i <= 3; ++i) {
    const double angle = RadiansFromDegrees(start_deg + 30 * i);
    points.push_back(center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

std::vector<Band> PlainWall(double low, double high) {
  return {{low, high, Material::kTile, kWhite, ""}};
}

// Tiles with bands of windows between the pairs of heights.
std::vector<Band> BandedWall(double low, double high, const std::vector<double>& windows) {
  std::vector<Band> bands;
  double from = low;
  for (size_t i = 0; i + 1 < windows.size(); i += 2) {
    const std::string number = std::to_string(i / 2 + 1);
    bands.push_back({from, windows[i], Material::kTile, kWhite, "tiles " + number});
    bands.push_back(
        {windows[i], windows[i + 1], Material::kWindowBand, kFrame, "windows " + number});
    from = windows[i + 1];
  }
  bands.push_back(
      {from, high, Material::kTile, kWhite, "tiles " + std::to_string(windows.size() / 2 + 1)});
  return bands;
}

// A flat polygon that faces up, given on the plan counterclockwise seen from above.
void AddRoof(WorldBuilder& builder,
             const std::vector<Eigen::Vector2d>& outline,
             double height,
             const std::string& name) {
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector2d& point : outline) corners.push_back({point.x(), point.y(), height});
  builder.AddPolygon(corners, Material::kRoof, kGravel, name);
}

// An opening into a wall that faces `outward`: back wall, two jambs and soffit. `from` and `to` are
// the opening's ends on the wall's line, walked with the outside on the right.
void AddRecess(WorldBuilder& builder,
               const Eigen::Vector2d& from,
               const Eigen::Vector2d& to,
               double depth,
               double height,
               Material back,
               const std::string& name) {
  const Eigen::Vector2d along = (to - from).normalized();
  const Eigen::Vector2d inward(-along.y(), along.x());
  const Eigen::Vector2d deep_from = from + depth * inward;
  const Eigen::Vector2d deep_to = to + depth * inward;
  builder.AddWall(deep_from, deep_to, {{0, height, back, kFrame, "back"}}, name);
  builder.AddWall(
      from, deep_from, {{0, height, Material::kConcrete, kConcreteGrey, "jamb 1"}}, name);
  builder.AddWall(deep_to, to, {{0, height, Material::kConcrete, kConcreteGrey, "jamb 2"}}, name);
  builder.AddPolygon({{from.x(), from.y(), height},
                      {deep_from.x(), deep_from.y(), height},
                      {deep_to.x(), deep_to.y(), height},
                      {to.x(), to.y(), height}},
                     Material::kConcrete,
                     kConcreteGrey,
                     name + " soffit");
}

// Four sides of a square column under a soffit.
void AddColumn(WorldBuilder& builder,
               const Eigen::Vector2d& center,
               double height,
               const std::string& name) {
  constexpr double kHalf = 1.25;
  const Eigen::Vector2d corners[4] = {center + Eigen::Vector2d(-kHalf, -kHalf),
                                      center + Eigen::Vector2d(kHalf, -kHalf),
                                      center + Eigen::Vector2d(kHalf, kHalf),
                                      center + Eigen::Vector2d(-kHalf, kHalf)};
  const char* sides[4] = {" south", " east", " north", " west"};
  for (int i = 0; i < 4; ++i) {
    builder.AddWall(corners[i],
                    corners[(i + 1) % 4],
                    {{0, height, Material::kConcrete, kConcreteGrey, ""}},
                    name + sides[i]);
  }
}

// The east wing: a slab 66 ft high whose east wall the thesis' s5 looks at, with two rounded
// corners to the north. On the plan: x 39 to 104, y -40 to 36.
void AddEastWing(WorldBuilder& builder) {
  constexpr double kTop = 66;
  const std::vector<Eigen::Vector2d> north_east = RoundedCorner(OnPlan(94, -30), 10, 0);
  const std::vector<Eigen::Vector2d> north_west = RoundedCorner(OnPlan(49, -30), 10, 90);
  // Walls run counterclockwise seen from above.
  builder.AddWall(OnPlan(104, 36),
                  OnPlan(104, 0),
                  BandedWall(0, kTop, {18, 23, 43, 48}),
                  "east wall south part");
  builder.AddWall(OnPlan(104, 0), north_east[0], PlainWall(0, kTop), "east wall north part");
  for (int i = 0; i < 3; ++i) {
    builder.AddWall(north_east[i],
                    north_east[i + 1],
                    PlainWall(0, kTop),
                    "north-east corner " + std::to_string(i + 1));
  }
  builder.AddWall(
      north_east[3], north_west[0], BandedWall(0, kTop, {31, 36, 46, 51}), "north wall");
  for (int i = 0; i < 3; ++i) {
    builder.AddWall(north_west[i],
                    north_west[i + 1],
                    PlainWall(0, kTop),
                    "north-west corner " + std::to_string(i + 1));
  }
  builder.AddWall(north_west[3], OnPlan(39, 0), PlainWall(0, kTop), "wing west wall");
  builder.AddWall(OnPlan(39, 0),
                  OnPlan(39, 36),
                  {{40, kTop, Material::kTile, kWhite, ""}},
                  "wing west wall above the roof");
  builder.AddWall(OnPlan(39, 36),
                  OnPlan(90, 36),
                  {{53, kTop, Material::kTile, kWhite, ""}},
                  "wing south wall above the roof");
  builder.AddWall(OnPlan(90, 36), OnPlan(104, 36), PlainWall(0, kTop), "wing south return");
  std::vector<Eigen::Vector2d> outline = {OnPlan(39, 36), OnPlan(104, 36)};
  outline.insert(outline.end(), north_east.begin(), north_east.end());
  outline.insert(outline.end(), north_west.begin(), north_west.end());
  AddRoof(builder, outline, kTop, "wing roof");
}

// The middle: 53 ft high over an arcade to the east. On the plan: x 39 to 90, y 36 to 110, with a
// rounded corner to the south-east.
void AddMiddle(WorldBuilder& builder) {
  constexpr double kTop = 53;
  constexpr double kArcade = 14;
  const std::vector<Eigen::Vector2d> south_east = RoundedCorner(OnPlan(80, 100), 10, -90);
  builder.AddWall(OnPlan(39, 110),
                  south_east[0],
                  BandedWall(0, kTop, {18, 23, 31, 36}),
                  "south wall east part");
  for (int i = 0; i < 3; ++i) {
    builder.AddWall(south_east[i],
                    south_east[i + 1],
                    PlainWall(0, kTop),
                    "south-east corner " + std::to_string(i + 1));
  }
  builder.AddWall(south_east[3], OnPlan(90, 92), PlainWall(0, kArcade), "pier south of the arcade");
  builder.AddWall(
      OnPlan(90, 44), OnPlan(90, 36), PlainWall(0, kArcade), "pier north of the arcade");
  builder.AddWall(south_east[3],
                  OnPlan(90, 36),
                  BandedWall(kArcade, kTop, {19, 24, 32, 37}),
                  "wall over the arcade");
  AddRecess(builder, OnPlan(90, 92), OnPlan(90, 44), 14, kArcade, Material::kStorefront, "arcade");
  for (int i = 0; i < 3; ++i) {
    AddColumn(
        builder, OnPlan(88.75, 56 + 12 * i), kArcade, "arcade column " + std::to_string(i + 1));
  }
  builder.AddWall(OnPlan(39, 36),
                  OnPlan(39, 110),
                  {{40, kTop, Material::kTile, kWhite, ""}},
                  "middle west wall above the roof");
  std::vector<Eigen::Vector2d> outline = {OnPlan(39, 36), OnPlan(39, 110)};
  outline.insert(outline.end(), south_east.begin(), south_east.end());
  outline.push_back(OnPlan(90, 36));
  AddRoof(builder, outline, kTop, "middle roof");
}

// The low west block with the entrance: 40 ft high, its top floor set back. On the plan: x 0 to
// 39, y 0 to 110, with a rounded corner to the south-west.
void AddWestBlock(WorldBuilder& builder) {
  constexpr double kTerrace = 27;
  constexpr double kTop = 40;
  constexpr double kDoor = 15;
  const std::vector<Eigen::Vector2d> south_west = RoundedCorner(OnPlan(10, 100), 10, 180);
  builder.AddWall(OnPlan(39, 0), OnPlan(30, 0), PlainWall(0, kDoor), "pier east of the entrance");
  builder.AddWall(OnPlan(10, 0), OnPlan(0, 0), PlainWall(0, kDoor), "pier west of the entrance");
  builder.AddWall(
      OnPlan(39, 0), OnPlan(0, 0), PlainWall(kDoor, kTerrace), "wall over the entrance");
  AddRecess(builder, OnPlan(30, 0), OnPlan(10, 0), 10, kDoor, Material::kStorefront, "entrance");
  builder.AddWall(OnPlan(0, 0), south_west[0], BandedWall(0, kTerrace, {13, 18}), "west wall");
  for (int i = 0; i < 3; ++i) {
    builder.AddWall(south_west[i],
                    south_west[i + 1],
                    PlainWall(0, kTerrace),
                    "south-west corner " + std::to_string(i + 1));
  }
  builder.AddWall(south_west[3], OnPlan(39, 110), PlainWall(0, kTerrace), "south wall west part");
  // The set-back floor: x 15 to 39, y 10 to 95.
  builder.AddWall(OnPlan(39, 10), OnPlan(15, 10), PlainWall(kTerrace, kTop), "setback north wall");
  builder.AddWall(
      OnPlan(15, 10), OnPlan(15, 95), BandedWall(kTerrace, kTop, {31, 36}), "setback west wall");
  builder.AddWall(OnPlan(15, 95), OnPlan(39, 95), PlainWall(kTerrace, kTop), "setback south wall");
  AddRoof(builder,
          {OnPlan(15, 95), OnPlan(39, 95), OnPlan(39, 10), OnPlan(15, 10)},
          kTop,
          "setback roof");
  std::vector<Eigen::Vector2d> terrace = {OnPlan(39, 0), OnPlan(0, 0)};
  terrace.insert(terrace.end(), south_west.begin(), south_west.end());
  for (const Eigen::Vector2d& point :
       {OnPlan(39, 110), OnPlan(39, 95), OnPlan(15, 95), OnPlan(15, 10), OnPlan(39, 10)}) {
    terrace.push_back(point);
  }
  AddRoof(builder, terrace, kTerrace, "terrace");
  builder.AddWall(OnPlan(39, 0),
                  OnPlan(39, 10),
                  {{kTerrace, kTop, Material::kTile, kWhite, ""}},
                  "wing west wall beside the terrace");
  builder.AddWall(OnPlan(39, 95),
                  OnPlan(39, 110),
                  {{kTerrace, kTop, Material::kTile, kWhite, ""}},
                  "middle west wall beside the terrace");
}

// One tile fits each flat face of a rounded corner, a little stretched.
void FitTilesToCorners(WorldBuilder& builder) {
  for (const char* corner : {"north-east", "north-west", "south-east", "south-west"}) {
    for (int i = 1; i <= 3; ++i) {
      Surface& surface = builder.SurfaceOf(
          builder.FaceNamed(std::string(corner) + " corner " + std::to_string(i)));
      const double scale = 5 / (surface.high_u - surface.low_u);
      surface.axis_u *= scale;
      surface.offset_u = 5 * i - scale * surface.low_u;
      surface.low_u = 5 * i;
      surface.high_u = 5 * (i + 1);
    }
  }
}

// Where the corners' quarter circles have their centres: in the photographed world they are round.
void RoundCorners(const WorldBuilder& builder, SyntheticWorld& world) {
  const std::pair<const char*, Eigen::Vector2d> corners[] = {{"north-east", OnPlan(94, -30)},
                                                             {"north-west", OnPlan(49, -30)},
                                                             {"south-east", OnPlan(80, 100)},
                                                             {"south-west", OnPlan(10, 100)}};
  for (const auto& [name, center] : corners) {
    SyntheticWorld::RoundCorner corner;
    corner.center_in_world = center;
    for (int i = 0; i < 3; ++i) {
      corner.faces[i] = builder.FaceNamed(std::string(name) + " corner " + std::to_string(i + 1));
    }
    world.round_corners.push_back(corner);
  }
}

// Machinery on the roof, and a stair tower.
void AddPenthouses(WorldBuilder& builder) {
  builder.AddBox(At(55, 20, 66),
                 At(90, -15, 77),
                 Material::kConcrete,
                 Material::kRoof,
                 kConcreteGrey,
                 "penthouse");
  builder.AddBox(
      At(46, 88, 53), At(60, 66, 63), Material::kTile, Material::kRoof, kWhite, "stair tower");
}

// What is painted, hung and lettered on the walls, none of it in the model.
void AddWallPictures(WorldBuilder& builder) {
  Surface& east = builder.SurfaceOf(builder.FaceNamed("east wall north part"));
  // A mural of coloured bars between the joints.
  east.decals.push_back(MakeDecal(MakeBars(), 12, 26, 16, 60));
  Surface& over_entrance = builder.SurfaceOf(builder.FaceNamed("wall over the entrance"));
  over_entrance.decals.push_back(
      MakeDecal(MakeLettering("ARTS AND MEDIA", Rgb(0.04f, 0.04f, 0.05f)), -34, 17.2, -6, 19.8));
  Surface& pier = builder.SurfaceOf(builder.FaceNamed("pier east of the entrance"));
  pier.decals.push_back(MakeDecal(MakePoster(3), -36.5, 4, -32, 11));
  Surface& west = builder.SurfaceOf(builder.FaceNamed("west wall tiles 2"));
  west.decals.push_back(
      MakeDecal(MakeLettering("GALLERY", Rgb(0.5f, 0.04f, 0.03f)), 12, 20.4, 27, 24.2));
  Surface& south = builder.SurfaceOf(builder.FaceNamed("south wall west part"));
  south.decals.push_back(MakeDecal(MakePoster(8), 16, 4.5, 23, 15));
  south.decals.push_back(MakeDecal(MakePoster(9), 27, 4.5, 34, 15));
}

}  // namespace

Subject MakeWiesner(uint64_t seed) {
  Subject subject;
  WorldBuilder builder(subject.world, SeedFor(seed, "wiesner"));
  AddEastWing(builder);
  AddMiddle(builder);
  AddWestBlock(builder);
  AddPenthouses(builder);
  FitTilesToCorners(builder);
  RoundCorners(builder, subject.world);
  AddWallPictures(builder);
  subject.world.num_model_faces = static_cast<int>(subject.world.geometry.faces.size());
  AddSurroundings(builder, OnPlan(52, 35), 150, seed);
  subject.views = {
      {"s1", {-95, -120, 5}, {25, 0, 30}, 58, "Across the plaza to the north-west"},
      {"s2", {-30, -150, 4.8}, {45, -10, 32}, 58, "By the bicycle racks"},
      {"s3", {60, -175, 5}, {70, -40, 32}, 58, "North lawn, opposite the north wall"},
      {"s4", {150, -165, 4.5}, {95, -40, 33}, 58, "North-east lawn"},
      {"s5",
       {232, -104, 4.5},
       {104, -2, 33.1},
       58,
       "This is a spot near the Henry Moore Sculpture"},
      {"s6", {245, 0, 5}, {104, 10, 32}, 58, "Opposite the east wall"},
      {"s7", {235, 110, 5}, {98, 50, 32}, 58, "East, beyond the arcade"},
      {"s8", {215, 190, 5}, {90, 80, 30}, 58, "South-east corner of the plaza"},
      {"s9", {130, 245, 5.2}, {70, 110, 30}, 58, "South, at the kerb"},
      {"s10", {50, 250, 5}, {45, 110, 30}, 58, "South, across the street"},
      {"s11", {-60, 235, 5}, {20, 105, 28}, 58, "South-west, across the street"},
      {"s12", {-130, 160, 5}, {5, 80, 28}, 58, "West lawn, south end"},
      {"s13", {-150, 60, 5}, {0, 50, 28}, 58, "West lawn"},
      {"s14", {-140, -40, 5}, {5, 30, 30}, 58, "West lawn, north end"},
      {"s15", {175, 40, 4.5}, {90, 65, 12}, 58, "Before the arcade"},
      {"s16", {160, -30, 4.5}, {104, -10, 20}, 58, "Close to the east wall"},
      {"s17", {75, -115, 4.5}, {72, -40, 25}, 58, "Close to the north wall"},
      {"s18", {15, -70, 4.5}, {22, 0, 14}, 58, "Before the entrance"},
      {"s19", {-75, 30, 4.5}, {0, 45, 20}, 58, "Close to the west wall"},
      {"s20", {30, 190, 4.5}, {42, 110, 22}, 58, "Close to the south wall"},
      {"s21", {300, -60, 62}, {100, 10, 35}, 58, "From the roof to the east"},
      {"s22", {-190, -60, 55}, {15, 20, 32}, 58, "From the library's top floor"},
      {"s23", {120, 300, 70}, {60, 90, 36}, 58, "From the roof to the south"},
  };
  subject.novel_views = {
      {"n1", {195, -135, 5}, {98, -20, 31}, 58, ""},
      {"n2", {-115, -85, 5}, {15, 15, 26}, 58, ""},
      {"n3", {190, 170, 28}, {85, 65, 28}, 58, ""},
  };
  return subject;
}

}  // namespace groundglass
