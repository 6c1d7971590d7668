// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/tiles1988/tiles.h"

#include "invrender/photos/face_mask.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/srgb.h"
#include "tests/invrender/painted_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numeric>

namespace groundglass {
namespace {

std::vector<Tile> TilesOf(const PolygonModel& model,
                          const BakePhotograph& photograph,
                          const std::vector<int>& faces,
                          int downsample = 1) {
  std::vector<Tile> tiles;
  TileOptions options;
  options.downsample = downsample;
  MakeTiles(model, Visibility(model), photograph, faces, options, [&](std::span<const Tile> some) {
    tiles.insert(tiles.end(), some.begin(), some.end());
  });
  return tiles;
}

// A wall far larger than the picture, seen at a slant.
struct WallScene {
  TemporaryFolder folder;
  PolygonModel model;
  int wall = AddWall(model, -100, 200, -100, 100);
  Camera camera = LookAt({6, -24, 5}, {14, 0, 6}, 500, 400, 520);
  BakePhotograph photograph = PhotographPainted(model, camera, kWaves, folder.path(), "s1");
};

TEST(MakeTiles, PhotographOf500By400Gives499By399) {
  const WallScene scene;
  const std::vector<Tile> tiles = TilesOf(scene.model, scene.photograph, {scene.wall});
  ASSERT_EQ(tiles.size(), 499u * 399u);
  // Each corner lies on the wall, on its pixel's line of sight, and has the wall's colour there.
  for (size_t i = 0; i < tiles.size(); i += 997) {
    const size_t row = i / 499;
    const auto x = static_cast<double>(i % 499);
    const auto y = static_cast<double>(row);
    const Eigen::Vector2d steps[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int c = 0; c < 4; ++c) {
      const TileCorner& corner = tiles[i].corners[c];
      const Eigen::Vector3d point = WorldFromSite(Eigen::Vector3d(corner.x, corner.y, corner.z));
      EXPECT_NEAR(point.y(), 0, 1e-5);
      const auto px = Project(scene.camera, point);
      ASSERT_TRUE(px);
      EXPECT_LT((*px - Eigen::Vector2d(x + 0.5, y + 0.5) - steps[c]).norm(), 1e-3);
      EXPECT_NEAR(LinearFromSrgb(corner.g), Waves(point)[1], 0.02);
    }
  }
}

TEST(MakeTiles, DownsamplingAveragesBlocksOfPixels) {
  const WallScene scene;
  for (const auto& [downsample, width, height] :
       {std::tuple{4, 250, 200}, {9, 166, 133}, {16, 125, 100}}) {
    const std::vector<Tile> tiles =
        TilesOf(scene.model, scene.photograph, {scene.wall}, downsample);
    ASSERT_EQ(tiles.size(), static_cast<size_t>((width - 1) * (height - 1)));
    const int side = downsample == 4 ? 2 : downsample == 9 ? 3 : 4;
    const TileCorner& corner = tiles[0].corners[2];  // of the second coarse pixel each way
    const auto px =
        Project(scene.camera, WorldFromSite(Eigen::Vector3d(corner.x, corner.y, corner.z)));
    ASSERT_TRUE(px);
    EXPECT_LT((*px - Eigen::Vector2d::Constant(1.5 * side)).norm(), 1e-3);
    const ImageF photograph = ReadRadiance(scene.photograph.image_file);
    double mean = 0;
    for (int i = 0; i < side * side; ++i) {
      mean += photograph.At(side + i % side, side + i / side)[0] / (side * side);
    }
    EXPECT_NEAR(LinearFromSrgb(corner.r), mean, 0.004);
  }
  EXPECT_EQ(ThrownMessage([&] { TilesOf(scene.model, scene.photograph, {scene.wall}, 2); }),
            "downsample must be 1, 4, 9 or 16");
}

TEST(MakeTiles, TilesStayWithinTheirFaceAndItsMask) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int wall = AddWall(model, 0, 30, 0, 12);
  const int pillar = AddWall(model, 14, 16, 0, 12, -4);
  const Camera camera = LookAt({6, -24, 6}, {14, 0, 6}, 480, 320, 330);
  BakePhotograph photograph = PhotographPainted(model, camera, kWaves, folder.path(), "a");
  Image8 mask(480, 320, 1);
  for (int y = 0; y < 320; ++y) std::fill_n(mask.At(0, y), 200, uint8_t{255});
  WriteSrgb8(folder / "mask.png", mask);
  photograph.mask_file = folder / "mask.png";
  const std::vector<Tile> tiles = TilesOf(model, photograph, {wall});
  ASSERT_GT(tiles.size(), 1000u);
  const Image16 labels = MakeFaceMask(model, Visibility(model), camera);
  for (const Tile& tile : tiles) {
    for (const TileCorner& corner : tile.corners) {
      const auto px = Project(camera, WorldFromSite(Eigen::Vector3d(corner.x, corner.y, corner.z)));
      ASSERT_TRUE(px);
      ASSERT_GE(px->x(), 200);
      ASSERT_EQ(*labels.At(static_cast<int>(px->x()), static_cast<int>(px->y())), wall + 1);
    }
  }
  EXPECT_GT(TilesOf(model, photograph, {pillar}).size(), 1000u);
}

TEST(PairFacesWithPhotographs, EachFaceGoesToTheOneThatShowsMostOfIt) {
  const TemporaryFolder folder;
  PolygonModel model;
  const int left = AddWall(model, 0, 10, 0, 8);
  const int right = AddWall(model, 40, 50, 0, 8);
  std::vector<BakePhotograph> photographs = {
      PhotographPainted(
          model, LookAt({5, -40, 4}, {5, 0, 4}, 160, 120, 150), kWaves, folder.path(), "far"),
      PhotographPainted(
          model, LookAt({5, -12, 4}, {5, 0, 4}, 160, 120, 100), kWaves, folder.path(), "near"),
      PhotographPainted(
          model, LookAt({45, -12, 4}, {45, 0, 4}, 160, 120, 100), kWaves, folder.path(), "other")};
  using Faces = std::vector<std::vector<int>>;
  EXPECT_EQ(PairFacesWithPhotographs(model, photographs), (Faces{{}, {left}, {right}}));
  // As in a table of pairs.
  photographs[1].faces = std::vector<int>{right};
  EXPECT_EQ(PairFacesWithPhotographs(model, photographs), (Faces{{left}, {}, {right}}));
}

TEST(TileFile, ComesBackAsItWasWritten) {
  const WallScene scene;
  const std::vector<Tile> tiles = TilesOf(scene.model, scene.photograph, {scene.wall}, 16);
  const std::filesystem::path file = scene.folder / "s1.tiles";
  WriteTiles(file, [&](const TileSink& append) { append(tiles); });
  EXPECT_EQ(std::filesystem::file_size(file), 96 * tiles.size());
  const MappedTiles mapped(file);
  ASSERT_EQ(mapped.Tiles().size(), tiles.size());
  EXPECT_EQ(std::memcmp(mapped.Tiles().data(), tiles.data(), 96 * tiles.size()), 0);
  // The first float is the first corner's x.
  float x = 0;
  std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(&x), sizeof(x));
  EXPECT_EQ(x, tiles[0].corners[0].x);
}

TEST(TileFile, SaysWhatIsWrongWithAFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "half.tiles") << "not a tile";
  EXPECT_THAT(ThrownMessage([&] { const MappedTiles tiles(folder / "half.tiles"); }),
              testing::HasSubstr("10 bytes are no whole number of tiles of 96"));
  EXPECT_THAT(ThrownMessage([&] { const MappedTiles tiles(folder / "none.tiles"); }),
              testing::HasSubstr("none.tiles: cannot read this as a file of tiles"));
  std::ofstream(folder / "empty.tiles").flush();
  EXPECT_TRUE(MappedTiles(folder / "empty.tiles").Tiles().empty());
}

TEST(TileRecord, GivesTheSameTilesAgain) {
  const WallScene scene;
  BakePhotograph photograph = scene.photograph;
  photograph.faces = std::vector<int>{scene.wall};
  TileRecord record{scene.model, {photograph}, {}};
  record.options.downsample = 9;
  WriteTileRecord(scene.folder / "tiles", record);
  const TileRecord again = ReadTileRecord(scene.folder / "tiles");
  std::vector<Tile> recomputed;
  const TileSink sink = [&](std::span<const Tile> some) {
    recomputed.insert(recomputed.end(), some.begin(), some.end());
  };
  RecomputeTiles(again, scene.camera, sink);
  const std::vector<Tile> tiles = TilesOf(scene.model, photograph, {scene.wall}, 9);
  ASSERT_EQ(recomputed.size(), tiles.size());
  for (size_t i = 0; i < tiles.size(); ++i) {
    for (int c = 0; c < 4; ++c) {
      EXPECT_NEAR(recomputed[i].corners[c].x, tiles[i].corners[c].x, 1e-4);
      EXPECT_EQ(recomputed[i].corners[c].g, tiles[i].corners[c].g);
    }
  }
  // Who stands behind the wall sees none of its tiles.
  recomputed.clear();
  RecomputeTiles(again, LookAt({6, 24, 5}, {14, 0, 6}, 500, 400, 520), sink);
  EXPECT_TRUE(recomputed.empty());

  std::ofstream(scene.folder / "tiles" / "record.json") << "{}";
  EXPECT_THAT(ThrownMessage([&] { ReadTileRecord(scene.folder / "tiles"); }),
              testing::HasSubstr("record.json: is no record of tiles"));
}

}  // namespace
}  // namespace groundglass
