// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/feature_tracks.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

// Keypoints are told apart by x: 10 times the photograph, plus their number.
FeatureMatches ThreePhotographs(int num_keypoints) {
  FeatureMatches matches;
  for (int photograph = 0; photograph < 3; ++photograph) {
    matches.keypoints.emplace_back();
    for (int k = 0; k < num_keypoints; ++k) {
      matches.keypoints.back().push_back({{10.0 * photograph + k, 0}, 1});
    }
  }
  return matches;
}

std::vector<std::vector<int>> NamesOf(const std::vector<FeatureTrack>& tracks) {
  std::vector<std::vector<int>> names;
  for (const FeatureTrack& track : tracks) {
    names.emplace_back();
    for (const TrackedKeypoint& tracked : track) {
      EXPECT_EQ(static_cast<int>(tracked.keypoint.image_px.x()) / 10, tracked.photograph);
      names.back().push_back(static_cast<int>(tracked.keypoint.image_px.x()));
    }
  }
  return names;
}

using Names = std::vector<std::vector<int>>;

TEST(FollowMatches, JoinsPairsIntoTracks) {
  FeatureMatches matches = ThreePhotographs(3);
  matches.pairs = {{0, 1, {{0, 2}, {2, 0}}}, {1, 2, {{2, 1}}}};
  EXPECT_EQ(NamesOf(FollowMatches(matches)), (Names{{0, 12, 21}, {2, 10}}));
}

TEST(FollowMatches, JoinsTracksThatMeetLate) {
  FeatureMatches matches = ThreePhotographs(2);
  matches.pairs = {{0, 2, {{1, 0}}}, {1, 2, {{1, 0}}}};
  EXPECT_EQ(NamesOf(FollowMatches(matches)), (Names{{1, 11, 20}}));
}

TEST(FollowMatches, APhotographIsInATrackOnceAndTheWeakerPairGivesWay) {
  FeatureMatches matches = ThreePhotographs(3);
  // 0 and 1 of the first photograph cannot both be 10: what the pair with more matches says stays.
  matches.pairs = {{0, 1, {{0, 0}}}, {0, 2, {{0, 0}, {2, 2}}}, {1, 2, {{0, 1}, {1, 0}, {2, 2}}}};
  for (const FeatureTrack& track : FollowMatches(matches)) {
    for (size_t i = 1; i < track.size(); ++i) {
      EXPECT_LT(track[i - 1].photograph, track[i].photograph);
    }
  }
  // 0-10 would bring 20 (through 0) and 21 (through 10) together.
  EXPECT_EQ(NamesOf(FollowMatches(matches)), (Names{{0, 11, 20}, {2, 12, 22}, {10, 21}}));
}

TEST(FollowMatches, WithoutMatchesThereAreNone) {
  EXPECT_TRUE(FollowMatches(ThreePhotographs(3)).empty());
  EXPECT_TRUE(FollowMatches({}).empty());
}

}  // namespace
}  // namespace groundglass
