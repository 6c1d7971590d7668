// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "viewer/tile_renderer.h"

#include "scene/frames.h"
#include "tests/viewer/sample_models.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

// A tile of the wall Y = `y`, front to the south, from (x0, z0) to (x1, z1), black on the left and
// white on the right.
Tile WallTile(float x0, float x1, float z0, float z1, float y = 0) {
  // North is -y in `site`.
  return {{{{x0, -y, z1, 0, 0, 0},
            {x1, -y, z1, 1, 1, 1},
            {x1, -y, z0, 1, 1, 1},
            {x0, -y, z0, 0, 0, 0}}}};
}

// One pixel a unit, 64 x 32 of them.
Camera CameraBeforeTiles() { return MakeCamera({32, -100, 16}, {32, 0, 16}, 64, 32, 100); }

TEST(TileRenderer, InterpolatesCodesBetweenCorners) {
  TileRenderer renderer(CameraBeforeTiles(), 1);
  const Tile tile = WallTile(8, 40, 8, 24);
  renderer.Draw({&tile, 1});
  const Image8 picture = renderer.Picture();
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool is_inside = x >= 8 && x < 40 && y >= 8 && y < 24;
      const double expected = is_inside ? 255 * (x + 0.5 - 8) / 32 : 255;
      ASSERT_NEAR(*picture.At(x, y), expected, 1) << x << " " << y;
    }
  }
}

TEST(TileRenderer, NearestWinsWhateverTheOrder) {
  Tile near = WallTile(0, 64, 0, 32, -50);
  for (TileCorner& corner : near.corners) corner.r = corner.g = corner.b = 0.2f;
  const Tile far = WallTile(0, 64, 0, 32);
  for (const bool near_first : {true, false}) {
    TileRenderer renderer(CameraBeforeTiles(), 2);
    renderer.Draw({near_first ? &near : &far, 1});
    renderer.Draw({near_first ? &far : &near, 1});
    const Image8 picture = renderer.Picture();
    for (const uint8_t value : picture.values) ASSERT_EQ(value, 51);
  }
}

TEST(TileRenderer, BacksAndWhatIsBehindTheCameraAreNotDrawn) {
  const Tile tile = WallTile(0, 64, 0, 32);
  for (const Camera& camera : {MakeCamera({32, 100, 16}, {32, 0, 16}, 64, 32, 100),
                               MakeCamera({32, -100, 16}, {32, -200, 16}, 64, 32, 100)}) {
    TileRenderer renderer(camera, 1);
    renderer.Draw({&tile, 1});
    const Image8 picture = renderer.Picture();
    for (const uint8_t value : picture.values) ASSERT_EQ(value, 255);
  }
}

}  // namespace
}  // namespace groundglass
