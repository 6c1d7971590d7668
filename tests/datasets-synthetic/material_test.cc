// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/material.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

class EachMaterial : public testing::TestWithParam<Material> {};

// What a far pixel shows is the mean of what near pixels show of the same place.
TEST_P(EachMaterial, LooksTheSameOnAverageFromAfar) {
  Surface surface;
  surface.material = GetParam();
  surface.seed = 42;
  surface.low_v = 0;
  surface.high_v = surface.coping_v = 60;
  surface.low_u = 0;
  surface.high_u = 100;
  constexpr double kSize = 20;  // feet
  constexpr int kCells = 200;
  Rgb mean = Rgb::Zero();
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const double step = kSize / kCells;
      mean +=
          AppearanceAt(surface, 30 + (i + 0.5) * step, 20 + (j + 0.5) * step, step, step).albedo;
    }
  }
  mean /= kCells * kCells;
  const Rgb far = AppearanceAt(surface, 40, 30, kSize, kSize).albedo;
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(far[c], mean[c], 0.15 * mean[c] + 0.01) << "channel " << c;
}

INSTANTIATE_TEST_SUITE_P(All,
                         EachMaterial,
                         testing::Values(Material::kTile,
                                         Material::kConcrete,
                                         Material::kRoof,
                                         Material::kPaving,
                                         Material::kGrass,
                                         Material::kAsphalt,
                                         Material::kBrick,
                                         Material::kStone,
                                         Material::kSlate,
                                         Material::kPlain));

TEST(Tiles, JointsAreDarkAndFiveFeetApart) {
  Surface surface;
  surface.material = Material::kTile;
  surface.color = Rgb(0.74f, 0.74f, 0.72f);
  surface.high_v = surface.coping_v = 60;
  EXPECT_LT(AppearanceAt(surface, 15, 32.5, 0.01, 0.01).albedo[1], 0.25);
  EXPECT_LT(AppearanceAt(surface, 17.5, 35, 0.01, 0.01).albedo[1], 0.25);
  EXPECT_GT(AppearanceAt(surface, 16.2, 33.8, 0.01, 0.01).albedo[1], 0.5);
}

TEST(Decal, CoversItsRectangleAloneAndAveragesItsColours) {
  ImageF rgba(2, 1, 4);
  rgba.values = {1, 0, 0, 1, 0, 0, 1, 1};  // red on the left, blue on the right
  Surface surface;
  surface.material = Material::kPlain;
  surface.color = Rgb::Zero();
  surface.decals.push_back(MakeDecal(rgba, 10, 0, 30, 10));
  EXPECT_NEAR(AppearanceAt(surface, 15, 5, 0.1, 0.1).albedo[0], 1, 1e-5);
  EXPECT_NEAR(AppearanceAt(surface, 25, 5, 0.1, 0.1).albedo[2], 1, 1e-5);
  EXPECT_NEAR(AppearanceAt(surface, 5, 5, 0.1, 0.1).albedo.sum(), 0, 1e-5);
  const Rgb whole = AppearanceAt(surface, 20, 5, 20, 10).albedo;
  EXPECT_NEAR(whole[0], 0.5, 1e-5);
  EXPECT_NEAR(whole[2], 0.5, 1e-5);
}

}  // namespace
}  // namespace groundglass
