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
              ElementsAre(HasSubstr("2 faces lie within others in the same plane, so that it is "
                                    "chance which of the two is seen there; the first: face 2, "
                                    "line 6, in face 1")));
}

}  // namespace
}  // namespace groundglass
