// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/nested_faces.h"

#include "scene/mend_faces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A rectangle in a tilted plane, `lift` off it.
void AddRectangle(
    double x0, double y0, double x1, double y1, PolygonModel& model, double lift = 0) {
  Face& face = model.faces.emplace_back();
  for (const auto& [x, y] :
       {std::pair(x0, y0), std::pair(x1, y0), std::pair(x1, y1), std::pair(x0, y1)}) {
    face.points.push_back(static_cast<int>(model.points_in_world.size()));
    model.points_in_world.emplace_back(3 + x, 0.6 * y - 0.8 * lift, 1 + 0.8 * y + 0.6 * lift);
  }
}

std::vector<std::pair<int, int>> Nested(const PolygonModel& model) {
  std::vector<int> faces(model.faces.size());
  std::iota(faces.begin(), faces.end(), 0);
  std::vector<std::pair<int, int>> pairs;
  for (const NestedFace& nested : FindNestedFaces(model, faces)) {
    pairs.emplace_back(nested.inner, nested.outer);
  }
  return pairs;
}

TEST(NestedFaces, APaneInAWallIsFound) {
  for (const double border : {0.0, 1.0}) {
    PolygonModel model;
    AddRectangle(0, 0, 10, 5, model);
    AddRectangle(border, border, 3, 4, model);
    EXPECT_THAT(Nested(model), ElementsAre(std::pair(1, 0))) << border;
    std::swap(model.faces[0], model.faces[1]);
    EXPECT_THAT(Nested(model), ElementsAre(std::pair(0, 1))) << border;
  }
}

TEST(NestedFaces, NeighboursPanesInHolesAndOthersAreNot) {
  PolygonModel model;
  AddRectangle(0, 0, 10, 5, model);
  // A window with a pane that fills it, over a bridge from the first corner.
  AddRectangle(2, 1, 4, 3, model);
  std::vector<int>& wall = model.faces[0].points;
  const std::vector<int>& pane = model.faces[1].points;
  wall.insert(wall.end(), {wall[0], pane[0], pane[3], pane[2], pane[1], pane[0]});
  AddRectangle(10, 0, 12, 5, model);       // beside
  AddRectangle(6, 1, 8, 3, model, 0.001);  // before
  AddRectangle(6, 1, 8, 3, model);
  std::reverse(model.faces.back().points.begin(), model.faces.back().points.end());
  AddRectangle(9, 1, 11, 3, model);  // overlaps the border
  EXPECT_THAT(Nested(model), IsEmpty());
}

TEST(NestedFaces, APieceInTheNotchOfAConcaveFaceIsNot) {
  PolygonModel model;
  AddRectangle(4, 0, 6, 4, model);  // between the legs
  Face& legs = model.faces.emplace_back();
  for (const auto& [x, y] : {std::pair(0, 0),
                             std::pair(4, 0),
                             std::pair(4, 4),
                             std::pair(6, 4),
                             std::pair(6, 0),
                             std::pair(10, 0),
                             std::pair(10, 8),
                             std::pair(0, 8)}) {
    legs.points.push_back(static_cast<int>(model.points_in_world.size()));
    model.points_in_world.emplace_back(3 + x, 0.6 * y, 1 + 0.8 * y);
  }
  EXPECT_THAT(Nested(model), IsEmpty());
  AddRectangle(4, 4, 6, 6, model);
  EXPECT_THAT(Nested(model), ElementsAre(std::pair(2, 1)));
}

TEST(NestedFaces, AFloorOfManyTilesIsNot) {
  PolygonModel model;
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < 100; ++column) {
      AddRectangle(column, row, column + 1, row + 1, model);
    }
  }
  EXPECT_THAT(Nested(model), IsEmpty());
  AddRectangle(50.25, 50.25, 50.75, 50.75, model);
  EXPECT_THAT(Nested(model), ElementsAre(std::pair(10000, 5050)));
}

TEST(MendFaces, TellsOfFacesWithinOthersOnce) {
  PolygonModel model;
  AddRectangle(0, 0, 10, 5, model);
  AddRectangle(1, 1, 2, 2, model);
  AddRectangle(3, 1, 4, 2, model);
  std::vector<FaceTexture> no_textures;
  const MendedFaces mended = MendFaces("m.osu", {5, 6, 7}, model, no_textures);
  EXPECT_THAT(mended.usable, ElementsAre(0, 1, 2));
  EXPECT_THAT(mended.warnings,
              ElementsAre(HasSubstr("2 faces lie within others in the same plane (the first: face "
                                    "2, line 6, in face 1); what lies within is cut out of the "
                                    "other")));
  EXPECT_NEAR(ComputeFaceArea(model, 0), 50 - 2, 1e-9);
  EXPECT_EQ(model.points_in_world.size(), 12);  // no corner but those that there were
}

// The area of each face once they are mended.
std::vector<double> AreasOf(PolygonModel& model) {
  std::vector<FaceTexture> no_textures;
  MendFaces("m.osu", {}, model, no_textures);
  std::vector<double> areas;
  for (size_t face = 0; face < model.faces.size(); ++face) {
    double area = 0;
    for (const auto& [a, b, c] : TriangulateFace(model, static_cast<int>(face))) {
      const auto& points = model.points_in_world;
      area += (points[b] - points[a]).cross(points[c] - points[a]).norm() / 2;
    }
    EXPECT_NEAR(area, ComputeFaceArea(model, static_cast<int>(face)), 1e-9);
    areas.push_back(area);
  }
  return areas;
}

void ExpectAreas(PolygonModel model, const std::vector<double>& expected) {
  const std::vector<double> areas = AreasOf(model);
  ASSERT_EQ(areas.size(), expected.size());
  for (size_t i = 0; i < areas.size(); ++i) EXPECT_NEAR(areas[i], expected[i], 1e-7) << i;
}

TEST(CutFaces, ADoorOnTheWallsFootLeavesANotch) {
  PolygonModel model;
  AddRectangle(0, 0, 10, 5, model);
  AddRectangle(4, 0, 5, 2, model);
  ExpectAreas(model, {48, 2});
  EXPECT_NE(AreasOf(model)[0], 50);
  EXPECT_EQ(model.faces[0].points.size(), 8);
}

TEST(CutFaces, PanesThatTouchAreCutOutTogether) {
  PolygonModel model;
  AddRectangle(0, 0, 10, 5, model);
  for (const double x : {2.0, 3.0}) {
    for (const double y : {1.0, 2.0}) AddRectangle(x, y, x + 1, y + 1, model);
  }
  AddRectangle(4, 1.5, 5, 2.5, model);  // at a corner of none
  AddRectangle(7, 3, 8, 4, model);
  ExpectAreas(model, {50 - 6, 1, 1, 1, 1, 1, 1});
}

TEST(CutFaces, APaneInAWindowInAWallIsCutOutOfBoth) {
  PolygonModel model;
  AddRectangle(0, 0, 10, 5, model);
  AddRectangle(2, 1, 4, 3, model);
  AddRectangle(2.5, 1.5, 3.5, 2.5, model);
  ExpectAreas(model, {46, 3, 1});
}

TEST(CutFaces, AWallThatFallsToPiecesOrVanishesStaysAndIsTold) {
  PolygonModel in_two;
  AddRectangle(0, 0, 10, 5, in_two);
  AddRectangle(4, 0, 5, 5, in_two);
  ExpectAreas(in_two, {50, 5});
  PolygonModel covered;
  AddRectangle(0, 0, 10, 5, covered);
  AddRectangle(0, 0, 4, 5, covered);
  AddRectangle(4, 0, 10, 5, covered);
  ExpectAreas(covered, {50, 20, 30});
  std::vector<FaceTexture> no_textures;
  EXPECT_THAT(MendFaces("m.osu", {}, covered, no_textures).warnings,
              ElementsAre(HasSubstr("it is chance which of the two is seen there")));
}

TEST(CutFaces, FarFromTheOriginAndOffByRoundingToo) {
  PolygonModel model;
  AddRectangle(0, 0, 10, 5, model);
  AddRectangle(4, 1e-9, 5, 2, model);
  AddRectangle(5 + 1e-9, 1, 6, 2, model);
  for (Eigen::Vector3d& point : model.points_in_world) {
    point += Eigen::Vector3d(4.5e5, 5.4e6, 300);
  }
  ExpectAreas(model, {47, 2, 1});
}

}  // namespace
}  // namespace groundglass
