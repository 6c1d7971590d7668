// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/polygon_model.h"

#include "scene/face_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace groundglass {
namespace {

// A star with `corners` tips in a tilted plane: concave at every second corner.
PolygonModel MakeStar(int corners, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> radius(0.4, 2);
  PolygonModel model;
  Face face;
  for (int i = 0; i < 2 * corners; ++i) {
    const double angle = std::numbers::pi * i / corners;
    const double r = i % 2 ? 0.3 : radius(random);
    const double u = r * std::cos(angle);
    const double v = r * std::sin(angle);
    model.points_in_world.push_back({10 + u, 20 + 0.6 * v, 5 + 0.8 * v});
    face.points.push_back(i);
  }
  model.faces.push_back(face);
  return model;
}

TEST(TriangulateFace, TrianglesOfAnyStarHaveItsAreaAndItsWinding) {
  for (int corners = 3; corners < 20; ++corners) {
    const PolygonModel model = MakeStar(corners, corners);
    const Eigen::Vector3d normal = ComputeFacePlane(model, 0).normal_in_world;
    double area = 0;
    const auto triangles = TriangulateFace(model, 0);
    EXPECT_EQ(triangles.size(), 2u * corners - 2);
    for (const auto& [a, b, c] : triangles) {
      const Eigen::Vector3d& p = model.points_in_world[a];
      const double signed_area =
          normal.dot((model.points_in_world[b] - p).cross(model.points_in_world[c] - p)) / 2;
      EXPECT_GT(signed_area, 0);
      area += signed_area;
    }
    EXPECT_NEAR(area, ComputeFaceArea(model, 0), 1e-9) << corners;
  }
}

TEST(TriangulateFace, CollinearCornersLoseNoArea) {
  PolygonModel model;
  model.points_in_world = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, {0, 0, 1}};
  model.faces = {{{0, 1, 2, 3, 4, 5}, ""}};
  double area = 0;
  for (const auto& [a, b, c] : TriangulateFace(model, 0)) {
    const Eigen::Vector3d& p = model.points_in_world[a];
    area += (model.points_in_world[b] - p).cross(model.points_in_world[c] - p).norm() / 2;
  }
  EXPECT_NEAR(area, 2, 1e-12);
}

// A wall with rows of equal windows, joined to its outline by bridges, that stands turned to the
// axes; coordinates as a file with three decimals has them.
PolygonModel WallOfWindows(int columns, int rows, double turn_rad) {
  std::vector<Eigen::Vector2d> points = {
      {0, 0}, {8.0 * columns + 3, 0}, {8.0 * columns + 3, 10.0 * rows + 2}, {0, 10.0 * rows + 2}};
  OutlineLoops loops;
  loops.loops.push_back({{0, 1, 2, 3}, -1});
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      const Eigen::Vector2d corner(2 + 8 * column, 2 + 10 * row);
      const int first = static_cast<int>(points.size());
      for (const auto& [right, up] : {std::pair(0, 0), {0, 5}, {4, 5}, {4, 0}}) {
        points.push_back(corner + Eigen::Vector2d(right, up));
      }
      loops.loops.push_back({{first, first + 1, first + 2, first + 3}, 0});
    }
  }
  const auto rounded = [](double value) { return std::round(value * 1000) / 1000; };
  PolygonModel model;
  for (const Eigen::Vector2d& point : points) {
    model.points_in_world.push_back({rounded(point.x() * std::cos(turn_rad)),
                                     rounded(point.x() * std::sin(turn_rad)),
                                     point.y()});
  }
  model.faces.push_back({BridgeHoles(points, loops)[0], "wall"});
  return model;
}

TEST(TriangulateFace, WindowsThatEndOnOneLineStayOpenAndLoseNoWall) {
  for (int turn = 0; turn < 60; ++turn) {
    for (const auto& [columns, rows] : {std::pair(1, 6), {4, 4}, {8, 12}}) {
      const PolygonModel model = WallOfWindows(columns, rows, 0.11 * turn);
      double area = 0;
      for (const auto& [a, b, c] : TriangulateFace(model, 0)) {
        const auto& p = model.points_in_world;
        area += 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm();
      }
      const double expected = (8 * columns + 3) * (10 * rows + 2) - 20 * columns * rows;
      EXPECT_NEAR(area, expected, 1e-3 * expected) << columns << " x " << rows << ", turn " << turn;
    }
  }
}

TEST(ComputeFacePlane, ACounterclockwiseFaceLooksAtItsViewer) {
  PolygonModel model;
  model.points_in_world = {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}};
  model.faces = {{{0, 1, 2, 3}, "seen from the south"}};
  const FacePlane plane = ComputeFacePlane(model, 0);
  EXPECT_LT((plane.normal_in_world - Eigen::Vector3d(0, -1, 0)).norm(), 1e-12);
  EXPECT_NEAR(plane.offset, 0, 1e-12);
  EXPECT_NEAR(ComputeFaceArea(model, 0), 12, 1e-12);
}

}  // namespace
}  // namespace groundglass
