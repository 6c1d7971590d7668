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
    alignment.registration.verdict = Verdict::kReview;
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
    EXPECT_FALSE(edge_model.group_offsets.empty());
    return std::vector<PhotographAlignment>(4, [] {
      PhotographAlignment better;
      better.registration.verdict = Verdict::kReview;
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
    EXPECT_LT((edge_model.MoveOf(static_cast<int>(edge)) - expected).norm(), 1e-9) << edge;
  }
  EXPECT_THAT(DescribeDisplacedGroup(displaced[0], edge_model), HasSubstr("0.79 ft higher"));
}

TEST_F(FindDisplacedGroupsTest, LeavesTheModelAsItWasWhereTheTrialSaysNoMore) {
  std::vector<PhotographAlignment> alignments = Alignments(4, level_set, 8, 30, 100);
  const auto align_all = [&] { return Alignments(4, level_set, 8, 30, 101); };
  EXPECT_TRUE(FindDisplacedGroups({}, align_all, edge_model, alignments).empty());
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

TEST_F(FindDisplacedGroupsTest, OfAnotherBuildingsPhotographsNoneHasASay) {
  std::vector<PhotographAlignment> alignments = Alignments(4, level_set, 8, 30, 100);
  const auto align_all = [&] {
    std::vector<PhotographAlignment> better = Alignments(4, level_set, 8, 0, 150);
    for (PhotographAlignment& alignment : better)
      alignment.registration.verdict = Verdict::kRejected;
    return better;
  };
  for (PhotographAlignment& alignment : alignments) {
    alignment.registration.verdict = Verdict::kRejected;
  }
  EXPECT_TRUE(FindDisplacedGroups({}, align_all, edge_model, alignments).empty());
}

TEST_F(FindDisplacedGroupsTest, ASetThatIsMovedTwiceIsToldOnce) {
  std::vector<PhotographAlignment> alignments = Alignments(4, level_set, 8, 30, 100);
  int num_trials = 0;
  const auto align_all = [&] {
    ++num_trials;
    return num_trials == 1 ? Alignments(4, level_set, 3, 20, 150)
                           : Alignments(4, level_set, 0, 0, 190);
  };
  const auto displaced = FindDisplacedGroups({}, align_all, edge_model, alignments);
  EXPECT_EQ(num_trials, 2);
  ASSERT_EQ(displaced.size(), 1u);
  EXPECT_NEAR(displaced[0].offset_units, 11 * edge_model.sigma, 1e-9);
}

TEST_F(FindDisplacedGroupsTest, ATrialInVainLeavesEdgesWhereTheyWereToTheLastBit) {
  std::vector<PhotographAlignment> alignments = Alignments(4, level_set, 8, 30, 100);
  std::vector<Eigen::Vector2d> after_first;
  int num_trials = 0;
  const auto align_all = [&] {
    ++num_trials;
    if (num_trials == 1) after_first = edge_model.group_offsets;
    // The second one is in vain.
    return Alignments(4, level_set, 3.5, 20, 150);
  };
  ASSERT_EQ(FindDisplacedGroups({}, align_all, edge_model, alignments).size(), 1u);
  EXPECT_EQ(num_trials, 2);
  EXPECT_EQ(edge_model.group_offsets, after_first);
}

struct TwoWaysTest : FindDisplacedGroupsTest {
  // A wall, and an edge of one that is parallel to it and has none of its planes.
  int wall = -1;
  int edge_opposite = -1;
  CameraPrior prior;
  CameraPrior prior_elsewhere;

  TwoWaysTest() {
    const auto& sets = edge_model.groups.sets;
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
    ViewTag tag;
    tag.position_in_site = {62, 48, 5};
    tag.lookat_in_site = {20, -4, 11};
    prior = MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, {});
    prior_elsewhere = prior;
  }

  // The first trial moves the wall, the second the one opposite, with a camera that lies elsewhere.
  std::vector<DisplacedGroup> Find(double first_nats,
                                   double second_nats,
                                   const CameraParameters& elsewhere,
                                   std::vector<PhotographAlignment>& alignments) {
    alignments = Alignments(4, wall, 8, 30, 100);
    int num_trials = 0;
    const auto align_all = [&] {
      ++num_trials;
      PhotographAlignment better;
      better.registration.verdict = Verdict::kReview;
      better.registration.width_px = 600;
      better.total_nats = num_trials == 1 ? first_nats : second_nats;
      better.aligned.prior = num_trials == 1 ? prior : prior_elsewhere;
      better.aligned.found.resize(1);
      better.aligned.found[0].sample.edge = edge_opposite;
      if (num_trials == 2) better.aligned.whitened = elsewhere;
      better.second_best = better.aligned;
      return std::vector<PhotographAlignment>(4, better);
    };
    auto displaced = FindDisplacedGroups({}, align_all, edge_model, alignments);
    EXPECT_EQ(num_trials, 2);
    return displaced;
  }
};

TEST_F(TwoWaysTest, ClaimsCoverBothWhereEitherOfTwoWallsMayBeOff) {
  ASSERT_GE(edge_opposite, 0);
  const CameraParameters elsewhere = CameraParameters::Unit(kPositionX);
  std::vector<PhotographAlignment> alignments;
  ASSERT_EQ(Find(150, 150, elsewhere, alignments).size(), 1u);
  const CameraParameters apart = prior.root.col(kPositionX);
  const CameraCovariance doubt = 0.5 * apart * apart.transpose();
  for (const PhotographAlignment& alignment : alignments) {
    EXPECT_LT((alignment.aligned.doubt - doubt).norm(), 1e-9);
    EXPECT_LT((alignment.second_best->doubt - doubt).norm(), 1e-9);
    EXPECT_LT((alignment.registration.covariance - doubt).norm(), 1e-9);
    EXPECT_NEAR(
        alignment.registration.sigmas[kPositionX], std::sqrt(0.5) * apart[kPositionX], 1e-9);
    EXPECT_GT(alignment.registration.vertex_sigma_px, 0);
  }
}

TEST_F(TwoWaysTest, TheWallThatPhotographsSayMoreForIsTheMovedOne) {
  std::vector<PhotographAlignment> alignments;
  // What one photograph may add is limited to 40.
  const auto displaced = Find(115, 138, CameraParameters::Zero(), alignments);
  ASSERT_EQ(displaced.size(), 1u);
  EXPECT_NE(displaced[0].set, wall);
  EXPECT_NEAR(displaced[0].offset_units, -8 * edge_model.sigma, 1e-9);
  EXPECT_EQ(alignments[0].total_nats, 138);
  const auto moves = MovesOfSet(edge_model.groups.sets[displaced[0].set], edge_model.groups);
  for (size_t edge = 0; edge < moves.size(); ++edge) {
    EXPECT_EQ(edge_model.MoveOf(static_cast<int>(edge)).isZero(), !moves[edge]) << edge;
  }
}

// Yaw is counted from -180 to 180 degrees: 179.9 and -179.9 are near.
TEST_F(TwoWaysTest, YawsOnBothSidesOfTheSeamAreNear) {
  prior.mean[kYaw] = 179.9;
  prior_elsewhere.mean[kYaw] = -179.9;
  std::vector<PhotographAlignment> alignments;
  Find(150, 150, CameraParameters::Zero(), alignments);
  EXPECT_LT(alignments[0].aligned.doubt(kYaw, kYaw), 0.1);
}

}  // namespace
}  // namespace groundglass
