// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/mend_faces.h"

#include "scene/face_outline.h"
#include "scene/feature_edges.h"
#include "scene/formats/model_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

int AddPoint(double x, double y, PolygonModel& model) {
  // In a tilted plane.
  model.points_in_world.push_back({3 + x, 0.6 * y, 1 + 0.8 * y});
  return static_cast<int>(model.points_in_world.size()) - 1;
}

std::vector<int> AddRectangleFace(double x0, double y0, double x1, double y1, PolygonModel& model) {
  return {AddPoint(x0, y0, model),
          AddPoint(x1, y0, model),
          AddPoint(x1, y1, model),
          AddPoint(x0, y1, model)};
}

MendedFaces Mend(PolygonModel& model) {
  std::vector<FaceTexture> no_textures;
  return MendFaces("m.osu", {}, model, no_textures);
}

double TriangleArea(const PolygonModel& model, int face) {
  const Eigen::Vector3d normal = ComputeFacePlane(model, face).normal_in_world;
  double sum = 0;
  for (const auto& [a, b, c] : TriangulateFace(model, face)) {
    const Eigen::Vector3d& p = model.points_in_world[a];
    const double area =
        normal.dot((model.points_in_world[b] - p).cross(model.points_in_world[c] - p)) / 2;
    EXPECT_GE(area, 0);
    sum += area;
  }
  return sum;
}

// A wall with windows in rows, each reached by a bridge from the wall's first corner, as careless
// programs write it: bridges run through windows and along one another.
PolygonModel WallWithWindows(int columns, int rows, bool is_turned, bool has_own_points) {
  PolygonModel model;
  const std::vector<int> wall = AddRectangleFace(0, 0, 4.0 * columns, 4.0 * rows, model);
  Face face;
  face.points = wall;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x = 4.0 * column + 1;
      const double y = 4.0 * row + 1;
      const std::vector<int> window = AddRectangleFace(x, y, x + 2, y + 1.5, model);
      // Back to the first corner, over, and around clockwise.
      const auto again = [&](int point) {
        if (!has_own_points) return point;
        model.points_in_world.push_back(Eigen::Vector3d(model.points_in_world[point]));
        return static_cast<int>(model.points_in_world.size()) - 1;
      };
      face.points.push_back(again(wall[0]));
      face.points.push_back(window[0]);
      for (const int k : is_turned ? std::vector<int>{1, 2, 3} : std::vector<int>{3, 2, 1}) {
        face.points.push_back(window[k]);
      }
      face.points.push_back(again(window[0]));
    }
  }
  model.faces.push_back(face);
  return model;
}

TEST(MendFaces, ManyWindowsOnCarelessBridgesLeaveTheRightArea) {
  for (const auto& [columns, rows] : {std::pair(1, 1), std::pair(3, 1), std::pair(5, 4)}) {
    for (const bool is_turned : {false, true}) {
      for (const bool has_own_points : {false, true}) {
        PolygonModel model = WallWithWindows(columns, rows, is_turned, has_own_points);
        const MendedFaces mended = Mend(model);
        ASSERT_THAT(mended.usable, ElementsAre(0)) << columns << is_turned << has_own_points;
        const double area = (16.0 - 3) * columns * rows;
        EXPECT_NEAR(ComputeFaceArea(model, 0), area, 1e-9);
        EXPECT_NEAR(TriangleArea(model, 0), area, 1e-9);
        EXPECT_EQ(mended.warnings.size(), is_turned ? 1u : 0u);
        // The wall's border and the windows', and no bridge.
        EXPECT_EQ(FindModelEdges(model).size(), 4u + 4u * columns * rows);
      }
    }
  }
}

TEST(MendFaces, AHoleThatTouchesTheOutlineIsOpen) {
  // The window's lower left corner is the wall's, and a second one stands on its lower side.
  PolygonModel model;
  const std::vector<int> wall = AddRectangleFace(0, 0, 10, 5, model);
  const int b = AddPoint(1, 3, model);
  const int c = AddPoint(3, 1, model);
  const int d = AddPoint(6, 0, model);
  const int e = AddPoint(6, 2, model);
  const int f = AddPoint(7, 2, model);
  model.faces.push_back({{wall[0], b, c, wall[0], d, e, f, d, wall[1], wall[2], wall[3]}, ""});
  ASSERT_THAT(Mend(model).usable, ElementsAre(0));
  EXPECT_NEAR(ComputeFaceArea(model, 0), 50 - 4 - 1, 1e-12);
  EXPECT_NEAR(TriangleArea(model, 0), 50 - 4 - 1, 1e-12);
}

// As above, its first window and the second one each wound as the wall is.
TEST(MendFaces, AHoleThatTouchesTheOutlineAndRunsTheSameWayIsTurned) {
  for (int turned = 1; turned < 4; ++turned) {
    PolygonModel model;
    const std::vector<int> wall = AddRectangleFace(0, 0, 10, 5, model);
    std::vector<int> corner_hole = {AddPoint(1, 3, model), AddPoint(3, 1, model)};
    const int d = AddPoint(6, 0, model);
    std::vector<int> side_hole = {AddPoint(6, 2, model), AddPoint(7, 2, model)};
    if (turned & 1) std::reverse(corner_hole.begin(), corner_hole.end());
    if (turned & 2) std::reverse(side_hole.begin(), side_hole.end());
    model.faces.push_back({{wall[0],
                            corner_hole[0],
                            corner_hole[1],
                            wall[0],
                            d,
                            side_hole[0],
                            side_hole[1],
                            d,
                            wall[1],
                            wall[2],
                            wall[3]},
                           ""});
    const MendedFaces mended = Mend(model);
    ASSERT_THAT(mended.usable, ElementsAre(0)) << turned;
    EXPECT_THAT(mended.warnings, ElementsAre(HasSubstr("it is turned")));
    EXPECT_NEAR(ComputeFaceArea(model, 0), 50 - 4 - 1, 1e-12) << turned;
    EXPECT_NEAR(TriangleArea(model, 0), 50 - 4 - 1, 1e-12) << turned;
  }
}

TEST(MendFaces, RandomFramesAreCutIntoTrianglesOfTheirArea) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(0, 1);
  for (int round = 0; round < 200; ++round) {
    // A star as a hole in a star, turned at random, over a random bridge.
    PolygonModel model;
    std::vector<int> outer;
    std::vector<int> inner;
    const int corners = 3 + round % 9;
    for (int i = 0; i < 2 * corners; ++i) {
      const double angle = M_PI * i / corners;
      const double r = i % 2 ? 3 + place(random) : 4 + 4 * place(random);
      outer.push_back(AddPoint(r * std::cos(angle), r * std::sin(angle), model));
    }
    for (int i = 0; i < 2 * corners; ++i) {
      const double angle = -M_PI * (i + place(random) / 2) / corners;
      const double r = i % 2 ? 0.2 : 0.3 + place(random);
      inner.push_back(AddPoint(r * std::cos(angle), r * std::sin(angle), model));
    }
    PolygonModel parts = model;
    parts.faces = {{outer, ""}, {inner, ""}};
    Face face{outer, ""};
    face.points.push_back(outer[0]);
    // The first of the hole's corners lies next to the ray to the outline's first corner.
    face.points.insert(face.points.end(), inner.begin(), inner.end());
    face.points.push_back(inner[0]);
    model.faces.push_back(face);
    ASSERT_THAT(Mend(model).usable, ElementsAre(0)) << round;
    const double area = ComputeFaceArea(parts, 0) - ComputeFaceArea(parts, 1);
    EXPECT_NEAR(TriangleArea(model, 0), area, 1e-9) << round;
  }
}

TEST(MendFaces, DropsCornersWithTheirTexels) {
  PolygonModel model;
  const std::vector<int> wall = AddRectangleFace(0, 0, 4, 3, model);
  model.faces.push_back({{wall[0], wall[1], wall[1], wall[2], wall[3], wall[0]}, "wall"});
  std::vector<FaceTexture> textures(1);
  textures[0] = {0, {{0, 0}, {4, 0}, {4, 0}, {4, 3}, {0, 3}, {0, 0}}};
  const MendedFaces mended = MendFaces("m.obj", {7}, model, textures);
  EXPECT_EQ(model.faces[0].points, wall);
  EXPECT_THAT(textures[0].corners_texel,
              ElementsAre(Eigen::Vector2d(0, 0),
                          Eigen::Vector2d(4, 0),
                          Eigen::Vector2d(4, 3),
                          Eigen::Vector2d(0, 3)));
  EXPECT_THAT(mended.warnings,
              ElementsAre("m.obj: 1 face repeats a corner or closes its ring; the corner is "
                          "dropped: face 1 (wall), line 7"));
}

TEST(MendFaces, FacesBackToBackAreDoublesAndTheFirstOnesFrontCounts) {
  PolygonModel model;
  const std::vector<int> wall = AddRectangleFace(0, 0, 4, 3, model);
  const std::vector<int> same = AddRectangleFace(0, 0, 4, 3, model);
  const std::vector<int> other = AddRectangleFace(0, 0, 4, 2.999, model);
  model.faces.push_back({wall, ""});
  model.faces.push_back({{same[2], same[1], same[0], same[3]}, ""});
  model.faces.push_back({other, ""});
  const MendedFaces mended = Mend(model);
  EXPECT_THAT(mended.usable, ElementsAre(0, 2));
  EXPECT_THAT(mended.warnings,
              ElementsAre("m.osu: 1 face lies twice and is kept once, the first of each: face 1 is "
                          "also face 2; they lie back to back, and the first one's front counts",
                          HasSubstr("1 face lies within another one in the same plane")));
}

TEST(MendFaces, WhatCoversItselfIsAFault) {
  // Around twice, a figure of eight, and an outline that is only a bridge.
  PolygonModel model;
  const std::vector<int> wall = AddRectangleFace(0, 0, 4, 3, model);
  model.faces.push_back(
      {{wall[0], wall[1], wall[2], wall[3], wall[0], wall[1], wall[2], wall[3]}, ""});
  model.faces.push_back({{wall[0], wall[2], wall[1], wall[3]}, ""});
  model.faces.push_back({{wall[0], wall[1], wall[2], wall[1]}, ""});
  const MendedFaces mended = Mend(model);
  EXPECT_THAT(mended.usable, IsEmpty());
  EXPECT_EQ(mended.faults.size(), 3u);
}

}  // namespace
}  // namespace groundglass
