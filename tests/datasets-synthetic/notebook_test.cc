// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "datasets-synthetic/notebook.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace groundglass {
namespace {

std::vector<ViewTag> MakeTags() {
  std::vector<ViewTag> tags(9);
  for (int i = 0; i < 9; ++i) {
    tags[i].position_in_site = {100 + 10.0 * i, -50, 5};
    tags[i].lookat_in_site = {1.0 * i, 0, 30};
  }
  return tags;
}

TEST(DrawBlunders, SpreadsAsManyAsAskedForOverTheKinds) {
  const std::vector<Blunder> blunders = DrawBlunders(9, 6, 4);
  for (const Blunder kind :
       {Blunder::kSwappedCoordinates, Blunder::kWrongSign, Blunder::kWrongPhotograph}) {
    EXPECT_EQ(std::count(blunders.begin(), blunders.end(), kind), 2);
  }
  EXPECT_EQ(std::count(blunders.begin(), blunders.end(), Blunder::kNone), 3);
  EXPECT_NE(DrawBlunders(9, 6, 5), blunders);
  EXPECT_THAT(
      DrawBlunders(1, 3, 4),
      testing::Not(testing::Contains(testing::AnyOf(Blunder::kNone, Blunder::kWrongPhotograph))));
}

TEST(CommitBlunders, EachIsWhatItsNameSays) {
  const std::vector<ViewTag> right = MakeTags();
  std::vector<ViewTag> tags = right;
  std::vector<Blunder> blunders(9, Blunder::kNone);
  blunders[0] = Blunder::kSwappedCoordinates;
  blunders[1] = Blunder::kWrongSign;
  blunders[2] = Blunder::kWrongPhotograph;
  CommitBlunders(blunders, 7, tags);
  EXPECT_EQ(tags[0].position_in_site, Eigen::Vector3d(-50, 100, 5));
  EXPECT_THAT(tags[1].position_in_site,
              testing::AnyOf(Eigen::Vector3d(-110, -50, 5), Eigen::Vector3d(110, 50, 5)));
  EXPECT_NE(tags[2], right[2]);
  EXPECT_THAT(right, testing::Contains(tags[2]));
  for (int i = 3; i < 9; ++i) EXPECT_EQ(tags[i], right[i]);
}

// A swap of 30 and 35 would be no blunder to speak of: the sign goes wrong instead.
TEST(CommitBlunders, AreNeverTooSmallToNotice) {
  std::vector<ViewTag> tags(1);
  tags[0].position_in_site = {30, 35, 5};
  CommitBlunders({Blunder::kSwappedCoordinates}, 7, tags);
  EXPECT_THAT(tags[0].position_in_site,
              testing::AnyOf(Eigen::Vector3d(-30, 35, 5), Eigen::Vector3d(30, -35, 5)));
}

}  // namespace
}  // namespace groundglass
