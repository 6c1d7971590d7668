// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "evaluate/texel_errors.h"

#include "datasets-synthetic/surface_truth.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/srgb.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

// A wall of 20 x 10 ft with texels of a tenth of a foot, red growing to the right.
TexturedModel MakeWall() {
  TexturedModel wall;
  wall.model.points_in_world = {{0, 0, 0}, {20, 0, 0}, {20, 0, 10}, {0, 0, 10}};
  wall.model.faces = {{{0, 1, 2, 3}, "wall"}};
  wall.faces = {{0, {{0, 100}, {200, 100}, {200, 0}, {0, 0}}}};
  wall.pages = {{Image8(200, 100, 3, 90), Image16(200, 100, 1, 1)}};
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) wall.pages[0].srgb8.At(x, y)[0] = static_cast<uint8_t>(20 + x);
  }
  return wall;
}

// The truth of that wall in texels of half a foot: five of the wall's own each way, whose middle
// one has the code 22 + 5 column. The border is not exact.
void WriteTruth(const TemporaryFolder& folder) {
  SurfaceChart chart;
  chart.face = 0;
  chart.page = 0;
  chart.left = 3;
  chart.top = 2;
  chart.width = 40;
  chart.height = 20;
  chart.corner_in_world = {0, 0, 10};
  chart.step_right_in_world = {0.5, 0, 0};
  chart.step_down_in_world = {0, 0, -0.5};
  folder.Write("charts.csv", FormatCharts({chart}));
  ImageF radiance(50, 30, 3);
  Image16 kinds(50, 30, 1);
  for (int row = 1; row < 19; ++row) {
    for (int column = 1; column < 39; ++column) {
      *kinds.At(3 + column, 2 + row) = static_cast<uint16_t>(TexelKind::kExact);
      const float codes[3] = {static_cast<float>(22 + 5 * column), 90, 90};
      for (int c = 0; c < 3; ++c) {
        radiance.At(3 + column, 2 + row)[c] = LinearFromSrgb(codes[c] / 255);
      }
    }
  }
  WriteRadiance(folder / "page_0.png", radiance, {.bits = 16});
  WriteLabels(folder / "kinds_0.png", kinds);
}

TEST(MeasureTexels, ExactTextureHasNoErrorAndGainIsFitted) {
  const TemporaryFolder folder;
  WriteTruth(folder);
  const TexelErrors exact = MeasureTexels(MakeWall(), folder.path());
  EXPECT_EQ(exact.num_texels, 38 * 18);
  EXPECT_EQ(exact.num_covered, 38 * 18);
  EXPECT_LT(exact.rms_levels, 0.1);
  TexturedModel dimmed = MakeWall();
  for (int i = 1; i < 200 * 100 * 3; i += 3) dimmed.pages[0].srgb8.values[i] = 45;
  const TexelErrors gained = MeasureTexels(dimmed, folder.path());
  EXPECT_LT(gained.rms_levels, 0.1);
  EXPECT_NEAR(gained.gain[1], 2, 0.01);
}

TEST(MeasureTexels, CountsALevelAsALevelAndLeavesOutWhatIsNotCovered) {
  const TemporaryFolder folder;
  WriteTruth(folder);
  TexturedModel wall = MakeWall();
  // Blue is off by 6 levels down and up by halves: the gain stays near 1, two of three channels
  // are right.
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) wall.pages[0].srgb8.At(x, y)[2] = x < 100 ? 84 : 96;
  }
  const TexelErrors errors = MeasureTexels(wall, folder.path());
  EXPECT_NEAR(errors.rms_levels, 6 / std::sqrt(3.0), 0.1);
  EXPECT_NEAR(errors.faces.at(0).rms_levels, 6 / std::sqrt(3.0), 0.1);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      *wall.pages[0].provenance.At(x, y) = x < 50 ? kProvenanceNone : kProvenanceFilled;
    }
  }
  EXPECT_EQ(MeasureTexels(wall, folder.path()).num_covered, 19 * 18);
  EXPECT_EQ(MeasureTexels(wall, folder.path()).num_texels, 38 * 18);
}

TEST(MeasureTexels, AChartBeyondItsPageIsAnError) {
  const TemporaryFolder folder;
  WriteTruth(folder);
  SurfaceChart chart;
  chart.face = chart.page = 0;
  chart.width = 51;
  chart.height = 1;
  folder.Write("charts.csv", FormatCharts({chart}));
  EXPECT_THAT([&] { MeasureTexels(MakeWall(), folder.path()); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("face 1 lies beyond its page")));
}

}  // namespace
}  // namespace groundglass
