// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/daylight.h"

#include "scene/visibility.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

// What the middle of a wall sees of the sky, which stands alone and leans by so much over its 10
// ft.
float SkyShareOfWall(double lean) {
  SyntheticWorld world;
  WorldBuilder builder(world, 1);
  builder.AddPolygon({{0, 0, 0}, {20, 0, 0}, {20, lean, 10}, {0, lean, 10}},
                     Material::kEven,
                     Rgb(0.5f, 0.5f, 0.5f),
                     "wall");
  const Visibility visibility(world.geometry);
  const SkyMap sky_map(world, visibility, {10, 0, 5}, 100);
  const Surface& wall = world.surfaces[0];
  const Eigen::Vector2d middle = wall.TextureOf({10, lean / 2, 5});
  return static_cast<float>(sky_map.SkyShare(wall, 0, middle.x(), middle.y()));
}

// Rounding must not decide what a place sees, or another build's pictures would differ.
TEST(SkyMap, AWallOutOfPlumbByARoundingErrorSeesAsMuchSky) {
  const float plumb = SkyShareOfWall(0);
  EXPECT_NEAR(plumb, 0.5, 0.02);
  EXPECT_FLOAT_EQ(SkyShareOfWall(1e-12), plumb);
  EXPECT_FLOAT_EQ(SkyShareOfWall(-1e-12), plumb);
}

}  // namespace
}  // namespace groundglass
