// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/photos/photo_cache.h"

#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

namespace groundglass {
namespace {

// Photographs of 64 x 48, each of one grey: 10, 20, 30 ...
std::vector<std::filesystem::path> WriteGreys(const TemporaryFolder& folder, int count) {
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < count; ++i) {
    files.push_back(folder / ("s" + std::to_string(i) + ".png"));
    WriteSrgb8(files.back(), Image8(64, 48, 3, static_cast<uint8_t>(10 * (i + 1))));
  }
  return files;
}

TEST(PhotoCache, HoldsNoMoreThanItMayAndForgetsTheOldest) {
  const TemporaryFolder folder;
  const std::vector<std::filesystem::path> files = WriteGreys(folder, 3);
  const size_t one = PhotoCache(files, 1 << 20).Get(0)->NumBytes();
  EXPECT_GT(one, 64u * 48 * 3);
  EXPECT_LT(one, 64u * 48 * 3 * 3 / 2);
  PhotoCache cache(files, 2 * one + 1);
  for (const int photo : {0, 1, 0, 2, 0}) {
    EXPECT_EQ(*cache.Get(photo)->Full().At(5, 5), 10 * (photo + 1));
    EXPECT_LE(cache.num_bytes(), 2 * one);
  }
  EXPECT_EQ(cache.num_decoded(), 3);
  cache.Get(1);  // had to make room for 2
  EXPECT_EQ(cache.num_decoded(), 4);
}

TEST(PhotoCache, EvenWithoutRoomEveryThreadGetsItsPhotograph) {
  const TemporaryFolder folder;
  PhotoCache cache(WriteGreys(folder, 5), 0);
  tbb::parallel_for(
      0, 500, [&](int i) { ASSERT_EQ(*cache.Get(i % 5)->Full().At(0, 0), 10 * (i % 5 + 1)); });
}

TEST(PhotoCache, WithoutTheFinestLevelsPlacesStayWhereTheyAre) {
  const TemporaryFolder folder;
  Image8 ramp(64, 48, 3);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) std::fill_n(ramp.At(x, y), 3, static_cast<uint8_t>(60 + 2 * x));
  }
  WriteSrgb8(folder / "ramp.png", ramp);
  PhotoCache cache({folder / "ramp.png"}, 0);
  const Eigen::Matrix2d footprint = 4 * Eigen::Matrix2d::Identity();
  const auto whole = PhotoCache({folder / "ramp.png"}, 0).Get(0);
  cache.SetNumDropped(2);
  // Whoever reads it first sees it whole.
  size_t num_bytes = 0;
  const auto coarse = cache.Get(0, [&](const PhotoPyramid& all) { num_bytes = all.NumBytes(); });
  EXPECT_EQ(num_bytes, whole->NumBytes());
  EXPECT_LT(coarse->NumBytes(), whole->NumBytes() / 12);
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(20.3, 17), {31, 24.5}, {44.8, 30}}) {
    const float expected = whole->Sample(at, footprint)[0];
    EXPECT_NEAR(coarse->Sample(at, footprint)[0], expected, 0.01 * expected);
  }
  // At least one level is left of however small a picture.
  PhotoCache coarsest({folder / "ramp.png"}, 0);
  coarsest.SetNumDropped(9);
  EXPECT_GT(coarsest.Get(0)->NumBytes(), 0u);
  EXPECT_NEAR(
      coarsest.Get(0)->Sample({32, 24}, footprint)[0], whole->Sample({32, 24}, footprint)[0], 0.02);
}

TEST(PhotoCache, AMissingFileIsAnError) {
  PhotoCache cache({"nowhere/s1.jpg"}, 1 << 20);
  EXPECT_THAT(ThrownMessage([&] { cache.Get(0); }), testing::HasSubstr("s1.jpg"));
}

}  // namespace
}  // namespace groundglass
