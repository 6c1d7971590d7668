// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/surface_truth.h"

#include "datasets-synthetic/ray_tracer.h"
#include "scene/error.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace groundglass {
namespace {

const Rgb kWhite(0.7f, 0.7f, 0.68f);

// A tiled wall of 20 x 10 ft that looks south, a glazed one to its right, and a roof with a notch.
SyntheticWorld MakeWalls() {
  SyntheticWorld world;
  WorldBuilder builder(world, 1);
  builder.AddPolygon(
      {{0, 0, 0}, {20, 0, 0}, {20, 0, 10}, {0, 0, 10}}, Material::kTile, kWhite, "tiles");
  builder.AddPolygon(
      {{20, 0, 0}, {40, 0, 0}, {40, 0, 10}, {20, 0, 10}}, Material::kStorefront, kWhite, "glass");
  builder.AddPolygon(
      {{0, 0, 10}, {20, 0, 10}, {20, 20, 10}, {10, 20, 10}, {10, 10, 10}, {0, 10, 10}},
      Material::kRoof,
      kWhite,
      "roof");
  world.num_model_faces = 3;
  return world;
}

struct Painted {
  std::vector<SurfaceChart> charts;
  SurfacePage page;

  TexelKind KindAt(int face, double x, double y, double z) const {
    const auto [column, row] = PlaceOf(face, {x, y, z});
    return static_cast<TexelKind>(
        *page.kinds.At(charts[face].left + column, charts[face].top + row));
  }
  Rgb ColorAt(int face, double x, double y, double z) const {
    const auto [column, row] = PlaceOf(face, {x, y, z});
    const float* color = page.radiance.At(charts[face].left + column, charts[face].top + row);
    return {color[0], color[1], color[2]};
  }

 private:
  std::pair<int, int> PlaceOf(int face, const Eigen::Vector3d& in_world) const {
    const SurfaceChart& chart = charts[face];
    const Eigen::Vector3d offset = in_world - chart.corner_in_world;
    const auto steps = [&](const Eigen::Vector3d& step) {
      return static_cast<int>(offset.dot(step) / step.squaredNorm());
    };
    return {steps(chart.step_right_in_world), steps(chart.step_down_in_world)};
  }
};

Painted Paint(const SyntheticWorld& world, double texel) {
  const PolygonModel model = world.Model();
  const Visibility visibility(world.geometry);
  const SkyMap sky_map(world, visibility, {20, 0, 5}, 100);
  Painted painted;
  painted.charts = LayOutSurfaces(model, {.texel = texel});
  painted.page =
      RenderSurfacePage(world, model, visibility, sky_map, MakeOvercast(1), painted.charts, 0);
  return painted;
}

TEST(Surfaces, ChartsAreMetricAndLieApart) {
  const std::vector<SurfaceChart> charts = LayOutSurfaces(MakeWalls().Model(), {.texel = 0.25});
  ASSERT_EQ(charts.size(), 3u);
  EXPECT_EQ(charts[0].width, 80);
  EXPECT_EQ(charts[0].height, 40);
  EXPECT_TRUE(charts[0].PointInWorld(0, 0).isApprox(Eigen::Vector3d(0, 0, 10)));
  EXPECT_TRUE(charts[0].PointInWorld(80, 40).isApprox(Eigen::Vector3d(20, 0, 0)));
  EXPECT_TRUE(charts[2].PointInWorld(80, 0).isApprox(Eigen::Vector3d(20, 20, 10)));
  for (const SurfaceChart& a : charts) {
    for (const SurfaceChart& b : charts) {
      if (a.face == b.face || a.page != b.page) continue;
      EXPECT_TRUE(a.left + a.width <= b.left || b.left + b.width <= a.left ||
                  a.top + a.height <= b.top || b.top + b.height <= a.top);
    }
  }
}

TEST(Surfaces, EveryTexelOfEveryFaceHasItsKind) {
  const Painted painted = Paint(MakeWalls(), 0.25);
  EXPECT_EQ(painted.KindAt(0, 7, 0, 7), TexelKind::kExact);
  // The last column reaches over to the glass.
  EXPECT_EQ(Paint(MakeWalls(), 0.3).KindAt(0, 19.9, 0, 7), TexelKind::kEdge);
  EXPECT_EQ(painted.KindAt(1, 22.1, 0, 4), TexelKind::kGlass);
  EXPECT_EQ(painted.KindAt(2, 15, 15, 10), TexelKind::kExact);
  EXPECT_EQ(painted.KindAt(2, 5, 15, 10), TexelKind::kNone);  // the notch
  EXPECT_GT(painted.ColorAt(1, 22.1, 0, 4).sum(), 0);
  // Joints where the wall has them: at the multiples of 5 ft.
  EXPECT_LT(painted.ColorAt(0, 15.05, 0, 7)[1], 0.8f * painted.ColorAt(0, 16.3, 0, 7)[1]);
  EXPECT_LT(painted.ColorAt(0, 12, 0, 5.05)[1], 0.8f * painted.ColorAt(0, 12, 0, 6.3)[1]);
  long num_known = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 80; ++x) {
      num_known +=
          *painted.page.kinds.At(painted.charts[0].left + x, painted.charts[0].top + y) > 0;
    }
  }
  EXPECT_EQ(num_known, 80 * 40);
}

// What lies in the wall or before it is told from the wall itself.
TEST(Surfaces, DeepWindowsAreReliefAndWhatStandsCloseHides) {
  SyntheticWorld world = MakeWalls();
  world.num_model_faces = 3;
  WorldBuilder builder(world, 2);
  const int sill = builder.AddPolygon(
      {{4, -0.3, 4}, {8, -0.3, 4}, {8, -0.3, 5}, {4, -0.3, 5}}, Material::kEven, kWhite, "sill");
  world.surfaces[sill].is_relief = true;
  const Painted painted = Paint(world, 0.25);
  EXPECT_EQ(painted.KindAt(0, 6.1, 0, 4.6), TexelKind::kRelief);
  EXPECT_EQ(painted.KindAt(0, 6.1, 0, 6.6), TexelKind::kExact);
}

// The rays of a camera square on to the wall, one texel for each pixel, see the page's colours.
TEST(Surfaces, AreWhatACameraSeesSquareOn) {
  const SyntheticWorld world = MakeWalls();
  const Painted painted = Paint(world, 0.25);
  const Visibility visibility(world.geometry);
  const SkyMap sky_map(world, visibility, {20, 0, 5}, 100);
  Camera camera;
  camera.width_px = 80;
  camera.height_px = 40;
  camera.focal_x_px = camera.focal_y_px = 40;  // at 10 ft a pixel is a quarter of a foot
  camera.center_x_px = 40;
  camera.center_y_px = 20;
  camera.cam_from_world.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  camera.cam_from_world.translation = -camera.cam_from_world.rotation * Eigen::Vector3d(10, -10, 5);
  const ImageF seen = RenderRadiance({world, visibility, sky_map, MakeOvercast(1)}, camera, 5);
  std::vector<double> differences;
  for (int y = 1; y < 39; ++y) {
    for (int x = 1; x < 79; ++x) {
      const float* texel =
          painted.page.radiance.At(painted.charts[0].left + x, painted.charts[0].top + y);
      differences.push_back(std::abs(seen.At(x, y)[1] - texel[1]) / texel[1]);
    }
  }
  std::sort(differences.begin(), differences.end());
  EXPECT_LT(differences[differences.size() / 2], 0.005);
  EXPECT_LT(differences[differences.size() * 99 / 100], 0.03);
}

TEST(Surfaces, ReadBackAsWrittenAndNameTheWrongLine) {
  const TemporaryFolder folder;
  const SyntheticWorld world = MakeWalls();
  const Visibility visibility(world.geometry);
  const SkyMap sky_map(world, visibility, {20, 0, 5}, 100);
  WriteSurfaces(folder.path(),
                world,
                world.Model(),
                visibility,
                sky_map,
                MakeOvercast(1),
                {.texel = 0.25, .page_width_px = 100, .page_height_px = 60});
  const std::vector<SurfaceChart> charts = ReadCharts(folder.path());
  ASSERT_EQ(charts.size(), 3u);
  EXPECT_EQ(charts[2].face, 2);
  EXPECT_TRUE(charts[0].PointInWorld(80, 40).isApprox(Eigen::Vector3d(20, 0, 0)));
  const Painted painted = Paint(world, 0.25);
  const SurfacePage page = ReadSurfacePage(folder.path(), charts[0].page);
  const Rgb painted_color = painted.ColorAt(0, 7.1, 0, 7.1);
  const float* read = page.radiance.At(charts[0].left + 28, charts[0].top + 11);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(read[c], painted_color[c], 1e-4);
  folder.Write("charts.csv", "face,page\n1,2,3\n");
  EXPECT_THAT([&] { ReadCharts(folder.path()); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("charts.csv:2: expected face")));
}

}  // namespace
}  // namespace groundglass
