// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/displaced_groups.h"

#include "tests/register/house.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace groundglass {
namespace {

using ::testing::HasSubstr;

// The entry of a profile that stands for an offset.
size_t EntryAt(double offset_sigmas, const GroupProfileOptions& options) {
  return static_cast<size_t>(
      std::lround((offset_sigmas + options.reach_sigmas) / options.step_sigmas));
}

// A set whose planes are level or upright.
int SetOfKind(const EdgeModel& edge_model, bool is_upright) {
  const auto& sets = edge_model.groups.sets;
  for (size_t set = 0; set < sets.size(); ++set) {
    if (sets[set].across_in_world.isZero() != is_upright) return static_cast<int>(set);
  }
  return -1;
}

// Photographs that would rather have a set elsewhere by so many nats each, and how much they say in
// all.
std::vector<PhotographAlignment> Alignments(
    int count, int set, double offset_sigmas, double suspicion_nats, double total_nats) {
  const GroupProfileOptions options;
  std::vector<PhotographAlignment> alignments(count);
  for (PhotographAlignment& alignment : alignments) {
    alignment.total_nats = total_nats;
    GroupProfile profile{set, {}};
    profile.gain_nats.assign(2 * EntryAt(0, options) + 1, -suspicion_nats);
    profile.gain_nats[EntryAt(offset_sigmas, options)] = 0;
    alignment.group_profiles.push_back(profile);
  }
  return alignments;
}

struct FindDisplacedGroupsTest : ::testing::Test {
  PolygonModel model = MakeHouse();
  EdgeModel edge_model{model};
  int level_set = SetOfKind(edge_model, false);
};

TEST_F(FindDisplacedGroupsTest, TakesASetToLieWherePhotographsFitMuchBetter) {
  std::vector<PhotographAlignment> alignments = Alignments(4, level_set, 8, 30, 100);
  int num_trials = 0;
  const auto align_all = [&] {
    ++num_trials;
    EXPECT_FALSE(edge_model.moves_in_world.empty());
    return std::vector<PhotographAlignment>(4, [] {
      PhotographAlignment better;
      better.total_nats = 150;
      return better;
    }());
  };
  const auto displaced = FindDisplacedGroups({}, align_all, edge_model, alignments);
  EXPECT_EQ(num_trials, 1);
  ASSERT_EQ(displaced.size(), 1u);
  EXPECT_EQ(displaced[0].set, level_set);
  EXPECT_NEAR(displaced[0].offset_units, 8 * edge_model.sigma, 1e-9);
  EXPECT_EQ(displaced[0].num_photographs, 4);
  EXPECT_EQ(alignments[0].total_nats, 150);
  const auto moves = MovesOfSet(edge_model.groups.sets[level_set], edge_model.groups);
  for (size_t edge = 0; edge < moves.size(); ++edge) {
    const Eigen::Vector3d expected = moves[edge]
                                         ? Eigen::Vector3d(displaced[0].offset_units * *moves[edge])
                                         : Eigen::Vector3d(Eigen::Vector3d::Zero());
    EXPECT_LT((edge_model.moves_in_world[edge] - expected).norm(), 1e-9) << edge;
  }
  EXPECT_THAT(DescribeDisplacedGroup(displaced[0], edge_model), HasSubstr("0.79 ft higher"));
}

TEST_F(FindDisplacedGroupsTest, LeavesTheModelAsItWasWhereTheTrialSaysNoMore) {
  std::vector<PhotographAlignment> alignments = Alignments(4, level_set, 8, 30, 100);
  const auto align_all = [&] { return Alignments(4, level_set, 8, 30, 101); };
  EXPECT_TRUE(FindDisplacedGroups({}, align_all, edge_model, alignments).empty());
  EXPECT_TRUE(edge_model.moves_in_world.empty());
  EXPECT_TRUE(edge_model.group_offsets.empty());
  EXPECT_EQ(alignments[0].total_nats, 100);
}

TEST_F(FindDisplacedGroupsTest, OnePhotographIsNotEnoughAndSmallOffsetsAreTheCommonSolutions) {
  const auto align_all = [&]() -> std::vector<PhotographAlignment> {
    ADD_FAILURE() << "no trial was called for";
    return {};
  };
  std::vector<PhotographAlignment> alone = Alignments(1, level_set, 8, 500, 100);
  EXPECT_TRUE(FindDisplacedGroups({}, align_all, edge_model, alone).empty());
  std::vector<PhotographAlignment> near = Alignments(4, level_set, 1, 30, 100);
  EXPECT_TRUE(FindDisplacedGroups({}, align_all, edge_model, near).empty());
}

TEST_F(FindDisplacedGroupsTest, CoversBothWaysWhereEitherOfTwoWallsMayBeOff) {
  // A wall, and an edge of one that is parallel to it and has none of its planes.
  const auto& sets = edge_model.groups.sets;
  int wall = -1;
  int edge_opposite = -1;
  for (size_t first = 0; first < sets.size() && edge_opposite < 0; ++first) {
    const auto of_first = MovesOfSet(sets[first], edge_model.groups);
    for (size_t second = 0; second < sets.size(); ++second) {
      if (sets[first].across_in_world.dot(sets[second].across_in_world) < 0.999) continue;
      const auto of_second = MovesOfSet(sets[second], edge_model.groups);
      for (size_t edge = 0; edge < of_first.size(); ++edge) {
        if (of_first[edge] || !of_second[edge] || first == second) continue;
        wall = static_cast<int>(first);
        edge_opposite = static_cast<int>(edge);
      }
    }
  }
  ASSERT_GE(edge_opposite, 0);
  std::vector<PhotographAlignment> alignments = Alignments(4, wall, 8, 30, 100);
  ViewTag tag;
  tag.position_in_site = {62, 48, 5};
  tag.lookat_in_site = {20, -4, 11};
  const CameraPrior prior = MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, {});
  // The second trial moves the wall opposite: as good, with a camera one of its sigmas away.
  int num_trials = 0;
  const auto align_all = [&] {
    ++num_trials;
    PhotographAlignment better;
    better.total_nats = 150;
    better.aligned.prior = prior;
    better.aligned.found.resize(1);
    better.aligned.found[0].sample.edge = edge_opposite;
    if (num_trials == 2) better.aligned.whitened[kPositionX] = 1;
    return std::vector<PhotographAlignment>(4, better);
  };
  ASSERT_EQ(FindDisplacedGroups({}, align_all, edge_model, alignments).size(), 1u);
  EXPECT_EQ(num_trials, 2);
  const CameraParameters apart = prior.root.col(kPositionX);
  EXPECT_LT((alignments[0].aligned.doubt - 0.5 * apart * apart.transpose()).norm(), 1e-9);
}

}  // namespace
}  // namespace groundglass
