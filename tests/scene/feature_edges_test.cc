// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/feature_edges.h"

#include "scene/view_tag.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

// A box with its floor, outward faces, x, y, z from the corner's coordinates to `size` further.
void AddBox(PolygonModel& model, const Eigen::Vector3d& corner, const Eigen::Vector3d& size) {
  const int first = static_cast<int>(model.points_in_world.size());
  for (int i = 0; i < 8; ++i) {
    model.points_in_world.push_back(
        corner + Eigen::Vector3d((i & 1) * size.x(), (i >> 1 & 1) * size.y(), (i >> 2) * size.z()));
  }
  for (const std::vector<int>& points : {std::vector<int>{0, 2, 3, 1},
                                         {4, 5, 7, 6},
                                         {0, 1, 5, 4},
                                         {2, 6, 7, 3},
                                         {0, 4, 6, 2},
                                         {1, 3, 7, 5}}) {
    Face face;
    for (const int point : points) face.points.push_back(first + point);
    model.faces.push_back(face);
  }
}

Camera LookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target) {
  ViewTag tag;
  tag.position_in_site = SiteFromWorld(position);
  tag.lookat_in_site = SiteFromWorld(target);
  tag.view_angle_deg = 50;
  return CameraFromTag(tag, 900, 600);
}

std::vector<VisibleSpan> SpansOf(const PolygonModel& model, const Camera& camera) {
  return FindVisibleSpans(model, FindModelEdges(model), Visibility(model), camera, 0);
}

TEST(FindModelEdges, ABoxHasTwelveCreasesOfARightAngle) {
  PolygonModel model;
  AddBox(model, {0, 0, 0}, {4, 3, 2});
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  ASSERT_EQ(edges.size(), 12u);
  for (const ModelEdge& edge : edges) {
    EXPECT_EQ(edge.kind, ModelEdge::Kind::kCrease);
    EXPECT_NEAR(edge.angle_deg, 90, 1e-9);
  }
}

// Hand-made models give each face points of its own.
TEST(FindModelEdges, FacesThatDoNotSharePointNumbersStillShareBorders) {
  PolygonModel model;
  model.points_in_world = {
      {0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {1, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}};
  model.faces = {{{0, 1, 2, 3}, ""}, {{4, 5, 6, 7}, ""}};
  int shared = 0;
  for (const ModelEdge& edge : FindModelEdges(model)) {
    if (edge.second_face < 0) continue;
    ++shared;
    EXPECT_EQ(edge.kind, ModelEdge::Kind::kCoplanar);
  }
  EXPECT_EQ(shared, 1);
}

// Exporters write each face's corners by themselves, rounded.
TEST(FindModelEdges, CornersATenthOfAMillimetreApartAreOne) {
  PolygonModel model;
  model.unit = LengthUnit::kMetre;
  model.points_in_world = {{0, 0, 0},
                           {8, 0, 0},
                           {8, 0, 9},
                           {0, 0, 9},
                           {8.0001, -0.0001, 0},
                           {16, 0, 0},
                           {16, 0, 9},
                           {8.0001, 0.0001, 9.0001}};
  model.faces = {{{0, 1, 2, 3}, ""}, {{4, 5, 6, 7}, ""}};
  EXPECT_EQ(FindModelEdges(model).size(), 7u);
  for (Eigen::Vector3d& point : model.points_in_world) point.x() += point.x() > 8 ? 0.05 : 0;
  EXPECT_EQ(FindModelEdges(model).size(), 8u) << "a gap that somebody drew";
}

TEST(FindModelEdges, BordersAreCutAtTJunctions) {
  PolygonModel model;
  // A tall wall beside two low ones.
  model.points_in_world = {
      {0, 0, 0}, {1, 0, 0}, {1, 0, 2}, {0, 0, 2}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, {2, 0, 2}};
  model.faces = {{{0, 1, 2, 3}, ""}, {{1, 4, 5, 6}, ""}, {{6, 5, 7, 2}, ""}};
  int shared = 0;
  for (const ModelEdge& edge : FindModelEdges(model)) shared += edge.second_face >= 0;
  EXPECT_EQ(shared, 3) << "lower and upper half of the tall wall's side, and the one between";
}

TEST(FindVisibleSpans, ABoxSeenFromItsCornerShowsNineOfTwelveEdges) {
  PolygonModel model;
  AddBox(model, {-2, -2, 0}, {4, 4, 4});
  const Camera camera = LookAt({14, -12, 11}, {0, 0, 2});
  const std::vector<VisibleSpan> spans = SpansOf(model, camera);
  ASSERT_EQ(spans.size(), 9u);
  int silhouettes = 0;
  for (const VisibleSpan& span : spans) {
    silhouettes += span.is_silhouette;
    EXPECT_NEAR((span.end_in_world - span.start_in_world).norm(), 4, 0.02) << "whole edges";
  }
  EXPECT_EQ(silhouettes, 6);
}

// The place where one building ends another's line is known from similar triangles.
TEST(FindVisibleSpans, APostHidesThePartOfAWallsEdgeBehindIt) {
  PolygonModel model;
  model.points_in_world = {{-10, 10, 0}, {10, 10, 0}, {10, 10, 4}, {-10, 10, 4}};
  model.faces = {{{0, 1, 2, 3}, "wall"}};
  AddBox(model, {-0.5, 0, 0}, {1, 0.001, 10});
  const Camera camera = LookAt({0, -10, 4}, {0, 10, 4});
  std::vector<double> ends;
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  for (const VisibleSpan& span : FindVisibleSpans(model, edges, Visibility(model), camera, 0)) {
    if (edges[span.edge].first_face != 0 || span.start_in_world.z() < 3.9) continue;
    if (std::abs(span.end_in_world.z() - span.start_in_world.z()) > 0.1) continue;
    ends.push_back(span.start_in_world.x());
    ends.push_back(span.end_in_world.x());
  }
  std::sort(ends.begin(), ends.end());
  ASSERT_EQ(ends.size(), 4u) << "left and right of the post";
  EXPECT_NEAR(ends[1], -1, 0.01);
  EXPECT_NEAR(ends[2], 1, 0.01);
}

TEST(FindVisibleSpans, ShallowCreasesShowOnlyAsSilhouettes) {
  // A roof of 6 degrees to each side: its ridge is a line only against the sky.
  const double rise = 5 * std::tan(RadiansFromDegrees(3));
  PolygonModel model;
  model.points_in_world = {
      {-5, 0, 0}, {0, 0, rise}, {0, 8, rise}, {-5, 8, 0}, {5, 0, 0}, {5, 8, 0}};
  model.faces = {{{0, 1, 2, 3}, ""}, {{1, 4, 5, 2}, ""}};
  const auto ridge_spans = [&](const Camera& camera) {
    int count = 0;
    for (const VisibleSpan& span : SpansOf(model, camera)) {
      count += span.start_in_world.z() > 0.9 * rise && span.end_in_world.z() > 0.9 * rise;
    }
    return count;
  };
  EXPECT_EQ(ridge_spans(LookAt({1, -6, 12}, {0, 4, 0})), 0);
  EXPECT_EQ(ridge_spans(LookAt({-20, 4, 0.3}, {0, 4, 0})), 1);
}

TEST(FindVisibleSpans, SpansStayInsideTheFrame) {
  PolygonModel model;
  AddBox(model, {-50, 0, 0}, {100, 20, 30});
  const Camera camera = LookAt({20, -40, 6}, {38, 10, 18});
  const std::vector<VisibleSpan> spans = SpansOf(model, camera);
  ASSERT_FALSE(spans.empty());
  for (const VisibleSpan& span : spans) {
    for (const Eigen::Vector3d& end : {span.start_in_world, span.end_in_world}) {
      const auto image_px = Project(camera, end);
      ASSERT_TRUE(image_px);
      EXPECT_GT(image_px->x(), -0.5);
      EXPECT_LT(image_px->x(), camera.width_px + 0.5);
      EXPECT_GT(image_px->y(), -0.5);
      EXPECT_LT(image_px->y(), camera.height_px + 0.5);
    }
  }
}

// Parallel rays along north, 1 cm a pixel, 6 x 4 m around a box of 4 x 2.
OrthographicView SouthElevation() {
  OrthographicView view;
  view.width_px = 600;
  view.height_px = 400;
  view.pixel_size = 0.01;
  view.corner_in_world = {-1, 0, 3};
  return view;
}

TEST(FindVisibleSpans, ByParallelRaysABoxIsARectangleOfItsTrueSize) {
  PolygonModel model;
  AddBox(model, {0, 0, 0}, {4, 3, 2});
  const OrthographicView view = SouthElevation();
  double length = 0;
  for (const VisibleSpan& span :
       FindVisibleSpans(model, FindModelEdges(model), Visibility(model), view, 0)) {
    EXPECT_NEAR(view.FromWorld(span.start_in_world).z(), 0, 1e-9);  // none of the back
    length += (span.end_in_world - span.start_in_world).norm();
  }
  EXPECT_NEAR(length, 2 * (4 + 2), 0.01);
}

TEST(FindVisibleSpans, WhatStandsBeforeASectionHidesNothing) {
  PolygonModel model;
  AddBox(model, {0, 0, 0}, {4, 3, 2});
  AddBox(model, {1, -2, 1.5}, {1, 1, 1});  // before a metre of the wall's top
  OrthographicView view = SouthElevation();
  const auto top_length = [&] {
    double length = 0;
    for (const VisibleSpan& span :
         FindVisibleSpans(model, FindModelEdges(model), Visibility(model), view, 0)) {
      const Eigen::Vector3d along = span.end_in_world - span.start_in_world;
      if (span.start_in_world.y() == 0 && std::abs(along.z()) < 1e-9) length += along.norm();
    }
    return length;
  };
  EXPECT_NEAR(top_length(), 7, 0.01);
  view.near_depth = -0.5;
  EXPECT_NEAR(top_length(), 8, 0.01);
}

}  // namespace
}  // namespace groundglass
