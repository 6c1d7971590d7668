// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/charts/charts.h"

#include "invrender/charts/packing.h"
#include "tests/invrender/painted_scene.h"

#include <gtest/gtest.h>

#include <random>

namespace groundglass {
namespace {

TEST(MakeCharts, WallIsUprightToScaleAndSeenFromItsFront) {
  PolygonModel model;
  AddWall(model, 3, 13, 1, 5);  // front towards -y
  const std::vector<Chart> charts = MakeCharts(model);
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_NEAR(charts[0].width, 10, 1e-12);
  EXPECT_NEAR(charts[0].height, 4, 1e-12);
  // Seen from -y, east is on the right and the top-left corner is (3, 0, 5).
  EXPECT_TRUE(charts[0].right_in_world.isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(charts[0].down_in_world.isApprox(-Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(charts[0].origin_in_world.isApprox(Eigen::Vector3d(3, 0, 5)));
}

TEST(MakeCharts, NeverMirrors) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    PolygonModel model;
    const Eigen::Vector3d a(normal(random), normal(random), normal(random));
    const Eigen::Vector3d b(normal(random), normal(random), normal(random));
    const Eigen::Vector3d c(normal(random), normal(random), normal(random));
    AddFace(model, {a, b, c});
    const Chart chart = MakeCharts(model)[0];
    // x right, y down, so the normal towards the viewer is down x right.
    EXPECT_GT(chart.down_in_world.cross(chart.right_in_world).dot((b - a).cross(c - a)), 0);
    EXPECT_NEAR(chart.right_in_world.dot(chart.down_in_world), 0, 1e-12);
  }
}

TEST(MakeCharts, CoplanarNeighboursShareAChartAlsoAcrossTJunctions) {
  PolygonModel model;
  AddWall(model, 0, 8, 0, 12);
  AddWall(model, 8, 16, 0, 5);
  AddWall(model, 8, 16, 5, 12);
  AddWall(model, 20, 30, 0, 12);                                   // in the plane, but apart
  AddWall(model, 16, 20, 0, 12, 1);                                // beside it, but behind
  AddFace(model, {{0, 0, 0}, {8, 0, 0}, {8, 0, -5}, {0, 0, -5}});  // faces the other way
  const std::vector<Chart> charts = MakeCharts(model);
  ASSERT_EQ(charts.size(), 4u);
  EXPECT_EQ(charts[0].faces, (std::vector<int>{0, 1, 2}));
  const std::vector<int> chart_of_face = ChartOfFace(charts, model.faces.size());
  EXPECT_EQ(chart_of_face[2], 0);
  EXPECT_NE(chart_of_face[3], 0);
}

TEST(ChartTexels, EveryTexelThatAFaceTouchesStandsForAPointOfTheFace) {
  PolygonModel model;
  AddFace(model, {{0.3, 0, 0.2}, {9.1, 0, 0.7}, {6.2, 0, 3.3}, {9.4, 0, 7.9}, {0.9, 0, 7.1}});
  std::vector<Chart> charts = MakeCharts(model);
  charts[0].SetTexelSize(0.25);
  const ChartTexels texels(model, charts[0]);
  double area = 0;
  for (int y = 0; y < texels.height(); ++y) {
    for (int x = 0; x < texels.width(); ++x) {
      if (texels.FaceAt(x, y) < 0) continue;
      area += texels.IsCentreInside(x, y) ? 0.25 * 0.25 : 0;
      const Eigen::Vector2d centre(x + 0.5, y + 0.5);
      EXPECT_LT((texels.PointAt(x, y) - centre).norm(), 0.7072);
    }
  }
  EXPECT_NEAR(area, ComputeFaceArea(model, 0), 0.5);
}

TEST(ChartTexels, SliverThinnerThanATexelIsNotLost) {
  PolygonModel model;
  AddWall(model, 0, 20, 0, 0.05);
  std::vector<Chart> charts = MakeCharts(model);
  charts[0].SetTexelSize(0.3);
  const ChartTexels texels(model, charts[0]);
  for (int x = 0; x < texels.width(); ++x) EXPECT_EQ(texels.FaceAt(x, 0), 0);
}

TEST(PackCharts, RectanglesWithTheirGuttersNeverOverlap) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> side(1, 90);
  std::vector<Chart> charts(200);
  for (Chart& chart : charts) {
    chart.width = side(random);
    chart.height = side(random);
    chart.SetTexelSize(1);
  }
  charts[17].texel_size = 0;  // no photograph shows it
  constexpr int kGutter = 5;
  const std::vector<PageSize> pages = PackCharts(charts, kGutter, 400);
  ASSERT_GT(pages.size(), 1u);
  EXPECT_EQ(charts[17].page, -1);
  for (size_t i = 0; i < charts.size(); ++i) {
    if (charts[i].page < 0) continue;
    EXPECT_GE(charts[i].x_on_page, kGutter);
    EXPECT_LE(charts[i].x_on_page + charts[i].width_texels + kGutter, pages[charts[i].page].width);
    EXPECT_LE(charts[i].y_on_page + charts[i].height_texels + kGutter,
              pages[charts[i].page].height);
    for (size_t j = 0; j < i; ++j) {
      if (charts[j].page != charts[i].page) continue;
      const auto apart = [&](int a, int size_a, int b, int size_b) {
        return a + size_a + 2 * kGutter <= b || b + size_b + 2 * kGutter <= a;
      };
      EXPECT_TRUE(apart(charts[i].x_on_page,
                        charts[i].width_texels,
                        charts[j].x_on_page,
                        charts[j].width_texels) ||
                  apart(charts[i].y_on_page,
                        charts[i].height_texels,
                        charts[j].y_on_page,
                        charts[j].height_texels));
    }
  }
}

}  // namespace
}  // namespace groundglass
