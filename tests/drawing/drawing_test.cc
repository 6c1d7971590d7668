// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/drawing.h"

#include "drawing/drawing_accuracy.h"
#include "drawing/drawing_lines.h"
#include "drawing/drawing_painter.h"
#include "tests/support/thrown_message.h"
#include "tests/viewer/sample_models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// In metres, whatever the sample says.
TexturedModel MetricBox() {
  TexturedModel box = MakeCheckeredBox();
  box.model.unit = LengthUnit::kMetre;
  return box;
}

// Two walls of a street that turns by 45 degrees: 4 m facing south, then 3 m facing southeast.
PolygonModel TurningStreet() {
  PolygonModel street;
  street.unit = LengthUnit::kMetre;
  const double s = 3 / std::sqrt(2.0);
  street.points_in_world = {{0, 0, 0},
                            {4, 0, 0},
                            {4, 0, 5},
                            {0, 0, 5},
                            {4, 0, 0},
                            {4 + s, s, 0},
                            {4 + s, s, 7},
                            {4, 0, 7}};
  street.faces = {{{0, 1, 2, 3}, "baker"}, {{4, 5, 6, 7}, "smith"}};
  return street;
}

double TotalLength(const std::vector<DrawnLine>& lines, DrawnLine::Kind kind) {
  double length = 0;
  for (const DrawnLine& line : lines) {
    if (line.kind == kind) length += (line.end_m - line.start_m).norm();
  }
  return length;
}

TEST(MakeElevation, TheViewerOfASouthWallHasEastAtTheRight) {
  const Drawing drawing = MakeElevation(MetricBox().model, {2}, "south");
  const DrawingPlane& plane = drawing.panels.at(0).plane;
  EXPECT_LT((plane.right_in_world - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((plane.up_in_world - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((plane.TowardsViewer() + Eigen::Vector3d::UnitY()).norm(), 1e-12);
  // u starts at the left end, v is the height.
  EXPECT_LT((plane.origin_in_world - Eigen::Vector3d(-2, -1.5, 0)).norm(), 1e-12);
  EXPECT_NEAR(drawing.UEnd() - drawing.UStart(), 4, 1e-12);
  EXPECT_NEAR(drawing.v_start, -1, 1e-12);
  EXPECT_NEAR(drawing.v_end, 1, 1e-12);
  EXPECT_NEAR(FacingDeg(plane), 180, 1e-9);
}

TEST(MakeElevation, ALeaningWallIsDrawnPlumb) {
  PolygonModel model;
  model.points_in_world = {{0, 0, 0}, {4, 0, 0}, {4, 0.2, 4}, {0, 0.2, 4}};
  model.faces = {{{0, 1, 2, 3}, "wall"}};
  const Drawing drawing = MakeElevation(model, {0}, "wall");
  EXPECT_NEAR(drawing.v_end - drawing.v_start, 4, 1e-12);
}

TEST(MakeElevation, FacesThatLookToOppositeSidesHaveNone) {
  EXPECT_THAT(ThrownMessage([] {
                MakeElevation(MetricBox().model, {2, 4}, "both");
              }),
              HasSubstr("its faces look to different sides"));
}

TEST(MakeAllElevations, ABoxHasFourSidesClockwiseFromNorth) {
  std::vector<std::string> names;
  for (const Drawing& drawing : MakeAllElevations(MetricBox().model)) names.push_back(drawing.name);
  EXPECT_THAT(names, ElementsAre("north", "east", "south", "west"));
}

TEST(MakeDevelopedFacade, FrontsComeSideBySideInTrueLength) {
  const PolygonModel street = TurningStreet();
  const Drawing drawing = MakeDevelopedFacade(street, {0, 1}, "street");
  ASSERT_EQ(drawing.panels.size(), 2u);
  EXPECT_NEAR(drawing.UEnd(), 7, 1e-12);
  EXPECT_NEAR(drawing.panels[1].u_on_sheet, 4, 1e-12);
  const DrawingGrid grid = MakeGrid(drawing, 0.01);
  EXPECT_EQ(grid.width_px, 700);
  const std::vector<PanelView> views = MakePanelViews(drawing, grid);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[1].first_column, 400);
  // The second front's upper right corner is the sheet's.
  const Eigen::Vector3d corner_px = views[1].view.FromWorld(street.points_in_world[6]);
  EXPECT_NEAR(corner_px.x(), 300, 1e-6);
  EXPECT_NEAR(corner_px.y(), 0, 1e-6);
  EXPECT_NEAR(corner_px.z(), 0, 1e-9);
}

TEST(FindDrawnLines, AnElevationOfABoxIsItsOutline) {
  const Drawing drawing = MakeElevation(MetricBox().model, {2}, "south");
  const std::vector<DrawnLine> lines = FindDrawnLines(MetricBox().model, drawing, 0.005);
  EXPECT_NEAR(TotalLength(lines, DrawnLine::Kind::kOutline), 2 * (4 + 2), 0.01);
  EXPECT_NEAR(TotalLength(lines, DrawnLine::Kind::kEdge), 0, 1e-9);
}

TEST(FindDrawnLines, ASectionCutsFloorRoofAndTwoWalls) {
  // East-west through the middle, seen from the south: 4 m wide, 2 m high.
  const Drawing drawing = MakeSection(MetricBox().model, {-5, 0}, {5, 0});
  const std::vector<DrawnLine> lines = FindDrawnLines(MetricBox().model, drawing, 0.005);
  EXPECT_NEAR(TotalLength(lines, DrawnLine::Kind::kCut), 2 * (4 + 2), 1e-6);
  for (const DrawnLine& line : lines) EXPECT_GE(line.start_m.x(), -1e-9);
}

TEST(FindDrawnLines, APlanHasNorthUp) {
  const Drawing drawing = MakePlan(MetricBox().model, 0.5);
  EXPECT_LT((drawing.panels[0].plane.up_in_world - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  const std::vector<DrawnLine> lines = FindDrawnLines(MetricBox().model, drawing, 0.005);
  EXPECT_NEAR(TotalLength(lines, DrawnLine::Kind::kCut), 2 * (4 + 3), 1e-6);
}

TEST(DrawingPainter, ATexelThatCoversAPixelIsReproduced) {
  const Image8 page = MakeCheckerPage(64, 32);
  const TexturedModel wall = MakeWall(64, 32, page);
  Renderer renderer(wall);
  const Drawing drawing = MakeElevation(wall.model, {0}, "wall");
  const DrawingPainter painter(renderer, drawing, MakeGrid(drawing, 1));
  EXPECT_EQ(painter.Colours(0, 32).values, page.values);
}

TEST(DrawingPainter, RowsAndPartsPutTogetherAreTheWhole) {
  // Wider than what OpenGL is asked for at once.
  const TexturedModel wall = MakeWall(100, 0.5, MakePlainPage(8, 8, 200, 40, 10));
  Renderer renderer(wall);
  DrawingOptions options;
  options.margin = 0.1;
  const Drawing drawing = MakeElevation(wall.model, {0}, "wall", options);
  const DrawingPainter painter(renderer, drawing, MakeGrid(drawing, 0.02));
  ASSERT_EQ(painter.Grid().width_px, 5010);
  const Image8 all = painter.Colours(0, painter.Grid().height_px);
  for (const int row : {0, 7, 20}) {
    const Image8 one = painter.Colours(row, 1);
    EXPECT_TRUE(std::equal(one.values.begin(), one.values.end(), all.At(0, row)));
  }
  // Paper, wall, paper: the wall's ends are at 5 and 5005.
  EXPECT_EQ(*all.At(4, 15), 255);
  for (const int x : {5, 4095, 4096, 5004}) EXPECT_EQ(*all.At(x, 15), 200) << x;
  EXPECT_EQ(*all.At(5005, 15), 255);
}

TEST(AssessDrawing, WarnsWhereTheScalePromisesMoreThanThereIs) {
  TexturedModel wall = MakeWall(12, 8, MakePlainPage(8, 8, 100, 100, 100));
  wall.model.unit = LengthUnit::kMetre;
  wall.model.sigma = 0.005;
  DrawingSources sources;
  sources.photographs = {"s1"};
  sources.faces = {{{0, 64, 0.020, 0.006, 0.5}}};
  Renderer renderer(wall);
  const Drawing drawing = MakeElevation(wall.model, {0}, "wall");
  const DrawingAccuracy at_50 = AssessDrawing(renderer, wall, drawing, sources, 50, 0.005);
  EXPECT_NEAR(at_50.promise_m, 0.0125, 1e-12);
  EXPECT_NEAR(at_50.photograph_pixel_m->middle, 0.020, 1e-12);
  EXPECT_EQ(at_50.off_plane_share, 0);
  EXPECT_THAT(
      DescribeAccuracy(at_50),
      ElementsAre("At 1:50 a pixel of the picture is 5 mm on the building; the photographs' "
                  "own pixel is 20 mm; one standard deviation of the model is 5 mm, of what "
                  "the cameras put on it 6 mm.",
                  "0 % of what is drawn lies off the plane; it is drawn square to the plane, "
                  "at the same scale.",
                  "What the model has not is drawn beside its place: a reveal 0.1 m deep by "
                  "50 mm, for the slant of the photographs."));
  EXPECT_THAT(AccuracyWarnings(at_50),
              ElementsAre("1:50 promises 12.5 mm (0.25 mm on paper), but half of the photographs' "
                          "pixels are larger than 20 mm; 1:100 fits them, or take photographs from "
                          "nearer, or with a longer lens"));
  EXPECT_THAT(AccuracyWarnings(AssessDrawing(renderer, wall, drawing, sources, 100, 0.01)),
              ElementsAre());
}

TEST(AssessDrawing, NamesWhatDominatesAndDoesNotWarnOfAnAssumption) {
  DrawingAccuracy accuracy;
  accuracy.promise_m = 0.0125;
  accuracy.camera_sigma_m = Spread{0.004, 0.005, 0.006};
  accuracy.model_sigma_m = 0.03;
  EXPECT_THAT(
      AccuracyWarnings(accuracy),
      ElementsAre("1:50 promises 12.5 mm (0.25 mm on paper), but the model is sure to 30 mm "
                  "only (the cameras to 5 mm); 1:200 fits, or measure the model better"));
  accuracy.is_model_sigma_assumed = true;
  EXPECT_THAT(AccuracyWarnings(accuracy), ElementsAre());
  EXPECT_THAT(
      DescribeAccuracy(accuracy).back(),
      HasSubstr("the 30 mm are assumed, and 1:50 promises 12.5 mm. If it was measured better"));
  accuracy.camera_sigma_m = Spread{0.01, 0.04, 0.05};
  EXPECT_THAT(
      AccuracyWarnings(accuracy),
      ElementsAre("1:50 promises 12.5 mm (0.25 mm on paper), but the cameras put photographs "
                  "on the model to 40 mm only; 1:200 fits, or take photographs from nearer, "
                  "or more that overlap"));
}

TEST(MakeSection, OutsideOfTheModelNothingIsCut) {
  const PolygonModel box = MetricBox().model;
  EXPECT_TRUE(CutsModel(box, MakeSection(box, {-5, 0}, {5, 0})));
  EXPECT_FALSE(CutsModel(box, MakeSection(box, {-5, -3}, {5, -3})));
  EXPECT_TRUE(CutsModel(box, MakePlan(box, 0.5)));
  EXPECT_FALSE(CutsModel(box, MakePlan(box, 3)));
}

// A wall that leans by a hand, and not evenly, seen from above: its best plane is as steep, and
// beside its foot or its top it lies far below or above the wall.
TEST(AssessDrawing, NothingLiesFartherBehindThanTheModelReaches) {
  TexturedModel wall;
  wall.model.unit = LengthUnit::kMetre;
  wall.model.points_in_world = {{0, 0, 0}, {10, 0, 0}, {10, 0.4, 3}, {0, 0.1, 3}};
  wall.model.faces = {{{0, 1, 2, 3}, "wall"}};
  wall.faces.resize(1);
  Renderer renderer(wall);
  const Drawing drawing = MakePlan(wall.model, 4);
  const DrawingAccuracy accuracy = AssessDrawing(renderer, wall, drawing, {}, 50, 0.005);
  EXPECT_LE(accuracy.most_behind_m, 4 + 1e-6);
  EXPECT_GT(accuracy.most_behind_m, 3.5);
  EXPECT_EQ(accuracy.most_before_m, 0);
}

TEST(AssessDrawing, CountsTexelsThatNoPhotographShows) {
  const TexturedModel wall = MakeWall(2, 1, MakePlainPage(4, 2, 90, 90, 90));
  DrawingSources sources;
  sources.photographs = {"s1"};
  sources.provenance = {Image16(4, 2, 1)};
  *sources.provenance[0].At(0, 0) = 1;
  Renderer renderer(wall);
  const Drawing drawing = MakeElevation(wall.model, {0}, "wall");
  EXPECT_NEAR(
      AssessDrawing(renderer, wall, drawing, sources, 50, 0.05).untextured_share, 7.0 / 8, 0.02);
}

}  // namespace
}  // namespace groundglass
