// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/notebook_overclaim.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace groundglass {
namespace {

ViewTag SomeTag() {
  ViewTag tag;
  tag.position_in_site = {30, 60, 5};
  tag.lookat_in_site = {20, 0, 10};
  return tag;
}

// Photographs that are exactly placed, so many times further from their tags than those claim.
std::vector<PhotographAlignment> DrawAlignments(int count, double overclaim, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const CameraPrior prior = MakeCameraPrior(SomeTag(), 600, 400, LengthUnit::kFoot, {}, {});
  std::vector<PhotographAlignment> alignments(count);
  for (PhotographAlignment& alignment : alignments) {
    alignment.is_clear = true;
    alignment.aligned.written = prior;
    alignment.aligned.prior = WithWiderPose(prior, overclaim);
    for (double& value : alignment.aligned.whitened) value = normal(random);
  }
  return alignments;
}

TEST(FindOverclaim, IsHowManyTimesFurtherOffTheCamerasAre) {
  const auto overclaim = FindOverclaim(DrawAlignments(200, 2.4, 1), {});
  ASSERT_TRUE(overclaim);
  EXPECT_NEAR(*overclaim, 2.4, 0.25);
}

TEST(FindOverclaim, IsNothingWhereTheTagsHold) {
  int num_false = 0;
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    num_false += FindOverclaim(DrawAlignments(8, 1, seed), {}).has_value();
  }
  EXPECT_LE(num_false, 6);
}

TEST(FindOverclaim, OneWrongTagIsNotTheNotebook) {
  std::vector<PhotographAlignment> alignments = DrawAlignments(5, 0.7, 3);
  alignments[2].aligned.whitened *= 20;
  EXPECT_FALSE(FindOverclaim(alignments, {}));
}

TEST(FindOverclaim, OnlyPhotographsThatAreClearlyPlacedTell) {
  std::vector<PhotographAlignment> alignments = DrawAlignments(8, 3, 4);
  EXPECT_TRUE(FindOverclaim(alignments, {}));
  for (size_t i = 2; i < alignments.size(); ++i) alignments[i].is_clear = false;
  EXPECT_FALSE(FindOverclaim(alignments, {}));
}

TEST(DescribeOverclaim, SaysHowManyTimesAndWhatToDo) {
  EXPECT_THAT(DescribeOverclaim(2.4),
              testing::AllOf(testing::HasSubstr("2.4 times"), testing::HasSubstr("sigma_lookat")));
}

// What OverclaimOfSet takes of alignments.
std::vector<CorrectedTag> TagsOf(const std::vector<PhotographAlignment>& alignments) {
  std::vector<CorrectedTag> tags;
  for (const PhotographAlignment& alignment : alignments) {
    const AlignedPhotograph& aligned = alignment.aligned;
    tags.push_back({&aligned.written,
                    aligned.prior.ParametersAt(aligned.whitened),
                    &alignment.registration.covariance});
  }
  return tags;
}

TEST(OverclaimOfSet, IsOneWhereTagsHoldOrFewTell) {
  EXPECT_EQ(OverclaimOfSet(TagsOf(DrawAlignments(40, 1, 5)), {}), 1);
  EXPECT_EQ(OverclaimOfSet(TagsOf(DrawAlignments(4, 3, 5)), {}), 1);
  EXPECT_NEAR(OverclaimOfSet(TagsOf(DrawAlignments(100, 1.6, 5)), {}), 1.6, 0.25);
}

}  // namespace
}  // namespace groundglass
