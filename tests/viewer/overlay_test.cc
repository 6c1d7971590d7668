// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/overlay.h"

#include "scene/error.h"
#include "tests/viewer/sample_models.h"
#include "viewer/edge_drawing.h"
#include "viewer/line_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace groundglass {
namespace {

TEST(LineDrawing, ALineCoversItsLengthTimesItsWidth) {
  for (const double width_px : {0.6, 1.0, 1.7, 4.2}) {
    CoverageMask coverage(100, 100, 1);
    AddLine(coverage, {20.3, 30.7}, {70.9, 61.2}, width_px);
    const double sum = std::accumulate(coverage.values.begin(), coverage.values.end(), 0.0);
    const double length = std::hypot(50.6, 30.5);
    EXPECT_NEAR(sum, length * width_px, 0.06 * length * width_px + 3) << width_px;
  }
}

TEST(LineDrawing, PlacesHoldToAFractionOfAPixel) {
  // A level line at 40.25: its ink's centre is there.
  CoverageMask coverage(60, 80, 1);
  AddLine(coverage, {-10, 40.25}, {90, 40.25}, 2);
  double sum = 0;
  double moment = 0;
  for (int y = 0; y < 80; ++y) {
    sum += *coverage.At(30, y);
    moment += *coverage.At(30, y) * (y + 0.5);
  }
  EXPECT_NEAR(sum, 2, 1e-5);
  EXPECT_NEAR(moment / sum, 40.25, 1e-5);
}

TEST(LineDrawing, LinesOutsideThePictureLeaveItAlone) {
  CoverageMask coverage(20, 20, 1);
  AddLine(coverage, {-50, -9}, {90, -9}, 3);
  AddLine(coverage, {25, -50}, {25, 90}, 3);
  AddLine(coverage, {-50, 1e7}, {1e7, 90}, 3);
  for (const float value : coverage.values) EXPECT_EQ(value, 0);
}

TEST(EdgeDrawing, DashesAndGapsAreAsLongAsTheyAreToldAlongABentLineToo) {
  Camera camera = MakeCamera({0, -10, 0}, {0, 0, 0}, 640, 480, 400);
  for (const double k1 : {0.0, -0.2}) {
    camera.k1 = k1;
    VisibleSpan span;
    span.start_in_world = {-6, 0, 4};
    span.end_in_world = {6, 0, 4};
    EdgeStyle style;
    style.colour = {255, 255, 255};
    style.width_px = style.silhouette_width_px = 2;
    const auto ink = [&] {
      Image8 picture(640, 480, 3);
      DrawEdges(picture, {span}, camera, style);
      return std::accumulate(picture.values.begin(), picture.values.end(), 0.0) / 255 / 3;
    };
    const double whole = ink();
    style.dash_px = 20;
    EXPECT_EQ(ink(), whole) << "without gaps";
    style.gap_px = 40;
    // Round ends stand out by less than half of the width.
    EXPECT_NEAR(ink() / whole, (20 + 1.7) / 60, 0.03) << k1;
  }
}

TEST(EdgeDrawing, BentLinesFollowTheLens) {
  Camera camera = MakeCamera({0, -10, 0}, {0, 0, 0}, 640, 480, 400);
  camera.k1 = -0.2;
  const auto points = ProjectSpan(camera, {-6, 0, 4}, {6, 0, 4});
  ASSERT_GT(points.size(), 20);
  for (const Eigen::Vector2d& point : points) {
    // Each is on the projection of the line: its ray passes through Z = 4 in the plane Y = 0.
    const Eigen::Vector3d ray = UnprojectToWorld(camera, point);
    EXPECT_NEAR(ray.z() / ray.y() * 10, 4, 1e-6);
  }
}

// The colours of the lines along one row of a picture that was grey.
TEST(Overlay, CorrectedEdgesLieWhereTheCameraProjectsThem) {
  const PolygonModel model = MakeCheckeredBox().model;
  const Visibility visibility(model);
  const std::vector<ModelEdge> edges = FindModelEdges(model);
  const Image8 grey = MakePlainPage(300, 200, 120, 120, 120);
  const Camera corrected = MakeCamera({0, -11.5, 0}, {0, 0, 0}, 300, 200, 300);
  Camera measured = corrected;
  measured.center_x_px += 12;
  const Image8 picture = DrawOverlay(grey, model, edges, visibility, measured, &corrected);

  // The front face's upright borders: x = -2 and 2 at depth 10, so 150 -+ 60.
  const auto is_cyan = [&](int x) {
    return picture.At(x, 95)[2] > 200 && picture.At(x, 95)[0] < 90;
  };
  EXPECT_TRUE(is_cyan(89) || is_cyan(90));
  EXPECT_TRUE(is_cyan(209) || is_cyan(210));
  // Measured: 12 px to the right, grey and lighter than the picture, on a darker casing.
  EXPECT_GT(*picture.At(101, 95) + *picture.At(102, 95), 2 * 130);
  EXPECT_LT(*picture.At(100, 95), 120);
  // Nothing inside the face: the hidden edges are gone.
  for (int x = 110; x < 200; ++x) EXPECT_EQ(*picture.At(x, 95), 120) << x;
}

TEST(Overlay, CamerasOfAnotherSizeAreRefused) {
  const PolygonModel model = MakeCheckeredBox().model;
  const Camera camera = MakeCamera({0, -11.5, 0}, {0, 0, 0}, 300, 200, 300);
  try {
    DrawOverlay(MakePlainPage(320, 200, 0, 0, 0),
                model,
                FindModelEdges(model),
                Visibility(model),
                camera,
                nullptr);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("measured camera is for an image of 300 x 200"));
  }
}

}  // namespace
}  // namespace groundglass
