// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/polygon_model.h"

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
