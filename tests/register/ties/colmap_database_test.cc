// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/colmap_database.h"

#include "tests/register/ties/colmap_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

// Image 7 is b.png, image 3 is a.png: not in the order in which they are asked for.
std::vector<ColmapFileImage> TwoImages() {
  return {{7, "b.png", 6, {10, 20, 2, 0, 0, 2, 30, 40, 0, -3, 3, 0}},
          {3, "a.png", 4, {1, 2, 1.5F, 0, 3, 4, 2.5F, 1, 5, 6, 3.5F, 2}}};
}

TEST(ColmapDatabase, GivesKeypointsAndMatchesInTheOrderAskedFor) {
  const TemporaryFolder folder;
  WriteColmapFile(folder / "d.db", TwoImages(), {{3, 7, {2, 0, 0, 1}}});
  const ColmapDatabase database(folder / "d.db");
  const FeatureMatches matches = database.ReadMatches({"b.png", "a.png"});
  ASSERT_EQ(matches.keypoints.size(), 2u);
  ASSERT_EQ(matches.keypoints[0].size(), 2u);
  ASSERT_EQ(matches.keypoints[1].size(), 3u);
  EXPECT_EQ(matches.keypoints[0][1].image_px, Eigen::Vector2d(30, 40));
  // A blob's shape that is 3 in size and turned by a quarter.
  EXPECT_FLOAT_EQ(matches.keypoints[0][1].scale_px, 3);
  EXPECT_FLOAT_EQ(matches.keypoints[1][2].scale_px, 3.5);
  ASSERT_EQ(matches.pairs.size(), 1u);
  EXPECT_EQ(matches.pairs[0].first, 0);
  EXPECT_EQ(matches.pairs[0].second, 1);
  // The database has a.png's keypoint first.
  EXPECT_THAT(matches.pairs[0].matches, ElementsAre(Pair(0, 2), Pair(1, 0)));
}

TEST(ColmapDatabase, LeavesOutMatchesWithOtherImages) {
  const TemporaryFolder folder;
  WriteColmapFile(folder / "d.db", TwoImages(), {{3, 7, {2, 0}}});
  EXPECT_TRUE(ColmapDatabase(folder / "d.db").ReadMatches({"a.png"}).pairs.empty());
}

TEST(ColmapDatabase, WritesALensAndForgetsMatches) {
  const TemporaryFolder folder;
  WriteColmapFile(folder / "d.db", TwoImages(), {{3, 7, {2, 0}}});
  Camera camera;
  camera.focal_x_px = 500;
  camera.focal_y_px = 510;
  camera.center_x_px = 300;
  camera.center_y_px = 200;
  camera.k1 = -0.1;
  {
    ColmapDatabase database(folder / "d.db");
    database.SetCamera("a.png", camera);
    camera.k3 = 0.01;
    database.SetCamera("b.png", camera);
    database.ForgetMatches();
    EXPECT_TRUE(database.ReadMatches({"a.png", "b.png"}).pairs.empty());
  }
  const ColmapFileCamera opencv = ReadColmapFileCamera(folder / "d.db", "a.png");
  EXPECT_EQ(opencv.model, 4);
  EXPECT_TRUE(opencv.is_prior);
  EXPECT_THAT(opencv.parameters, ElementsAre(500, 510, 300, 200, -0.1, 0, 0, 0));
  const ColmapFileCamera full = ReadColmapFileCamera(folder / "d.db", "b.png");
  EXPECT_EQ(full.model, 6);
  EXPECT_THAT(full.parameters, ElementsAre(500, 510, 300, 200, -0.1, 0, 0, 0, 0.01, 0, 0, 0));
}

TEST(ColmapDatabase, KeepsNotes) {
  const TemporaryFolder folder;
  WriteColmapFile(folder / "d.db", TwoImages(), {});
  EXPECT_EQ(ColmapDatabase(folder / "d.db").Note("features"), "");
  ColmapDatabase(folder / "d.db").SetNote("features", "abc");
  EXPECT_EQ(ColmapDatabase(folder / "d.db").Note("features"), "abc");
}

TEST(ColmapDatabase, WhatIsNoneIsNamedWithWhatToDo) {
  const TemporaryFolder folder;
  const auto file = folder.Write("d.db", "this is no database at all, but text of some length");
  EXPECT_EQ(ThrownMessage([&] { ColmapDatabase database(file); }),
            file.string() +
                ": cannot be read as COLMAP's database: file is not a database; delete it, and it "
                "is made again");
}

TEST(ColmapDatabase, AMatchOfAKeypointThatIsNotThereIsNamed) {
  const TemporaryFolder folder;
  WriteColmapFile(folder / "d.db", TwoImages(), {{3, 7, {3, 0}}});
  const ColmapDatabase database(folder / "d.db");
  EXPECT_THAT(ThrownMessage([&] {
                database.ReadMatches({"a.png", "b.png"});
              }),
              HasSubstr("a match names a keypoint that is not there"));
  EXPECT_THAT(ThrownMessage([&] { database.ReadMatches({"c.png"}); }),
              HasSubstr("it has no image 'c.png'"));
}

}  // namespace
}  // namespace groundglass
