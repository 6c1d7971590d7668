// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/judge_members.h"

#include "register/camera/mean_displacement.h"
#include "tests/register/photographs_of_house.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kCovariance = 0.01;  // of each whitened parameter, as the common solution has it

// A set whose photographs show every visible edge of the house exactly where their cameras see it.
// No pictures: what is judged is what the set holds.
struct JudgeMembersTest : testing::Test {
  PolygonModel model = MakeHouse();
  EdgeModel edge_model{model};
  std::vector<PhotographAlignment> alignments;
  PhotographSet set;
  JointRefinement joint;
  RegisterOptions options;

  JudgeMembersTest() { options.use_ties = false; }

  static CameraPrior PriorOf(size_t i) {
    return MakeCameraPrior(
        TrueTagsOfHouse()[i % 4], kSmallWidth, kSmallHeight, LengthUnit::kFoot, {}, {});
  }

  // So many photographs; whitened: where the common solution has found the i-th one's camera.
  template <typename WhitenedOf>
  void MakeSet(size_t count, WhitenedOf whitened_of) {
    alignments.resize(count);
    for (size_t i = 0; i < count; ++i) {
      AlignedPhotograph photograph;
      photograph.prior = PriorOf(i);
      photograph.written = photograph.prior;
      photograph.whitened = whitened_of(i);
      photograph.width_px = kSmallWidth;
      ShowEdges(photograph);
      Registration& registration = alignments[i].registration;
      registration.name = "s" + std::to_string(i + 1);
      registration.width_px = kSmallWidth;
      registration.height_px = kSmallHeight;
      registration.measured = photograph.prior.measured;
      set.Add(alignments[i], photograph, 0);
      JointSolution solution;
      solution.whitened = photograph.whitened;
      solution.covariance = kCovariance * CameraCovariance::Identity();
      solution.num_matched = 40 + static_cast<int>(i);
      joint.photographs.push_back(solution);
    }
  }

  void ShowEdges(AlignedPhotograph& photograph) const {
    const ParameterProjection projection = photograph.prior.ProjectionAt(photograph.whitened);
    const std::vector<EdgeSample> samples =
        SampleVisibleEdges(edge_model, photograph.prior.CameraAt(photograph.whitened), -3, 10);
    const std::vector<ProjectedSample> projected = ProjectSamples(samples, projection);
    for (size_t i = 0; i < samples.size(); ++i) {
      CandidateSample found;
      found.sample = samples[i];
      photograph.found.push_back(found);
      ScoreSample scored;
      scored.point_in_world = samples[i].point_in_world;
      scored.edge = samples[i].edge;
      scored.observations = 1;
      scored.origin_px = projected[i].image_px;
      scored.normal = projected[i].normal;
      scored.range_px = 12;
      scored.candidates = {{0, 1}};
      photograph.score_samples.push_back(scored);
    }
  }

  void Judge() { JudgeMembers(joint, edge_model, options, set); }

  const Registration& Of(size_t i) const { return alignments[i].registration; }

  // Of the cameras that lie one standard deviation from the tag in one parameter the likeliest.
  static CameraParameters Towards(CameraParameter parameter, const CameraPrior& prior) {
    return prior.root.row(parameter).transpose().normalized();
  }

  // What the common solution claims for the i-th camera's parameters.
  CameraCovariance ClaimOf(size_t i) const {
    const CameraCovariance& root = set.photographs[i].prior.root;
    return kCovariance * root * root.transpose();
  }

  // The i-th photograph, had it come into the set with a camera so far from the one it has, whose
  // edges and tag say so much less.
  void CameFrom(size_t i, const CameraParameters& apart, double less_nats) {
    const AlignedPhotograph& photograph = set.photographs[i];
    const AlignmentScore score = ScoreOf(photograph, {}, options.solutions.score);
    set.alone[i] = {photograph.whitened + apart, NatsFor(photograph, score) - less_nats};
  }

  double DistancePx(size_t i, const CameraParameters& apart) const {
    const AlignedPhotograph& photograph = set.photographs[i];
    std::vector<Eigen::Vector3d> points_in_world;
    for (const CandidateSample& found : photograph.found) {
      points_in_world.push_back(found.sample.point_in_world);
    }
    return MeanDisplacementPx(points_in_world,
                              photograph.prior.ProjectionAt(photograph.whitened),
                              photograph.prior.ProjectionAt(photograph.whitened + apart));
  }
};

CameraParameters AtTheTag(size_t) { return CameraParameters::Zero(); }

TEST_F(JudgeMembersTest, RegistrationsReceiveWhatTheCommonSolutionFound) {
  MakeSet(2, [](size_t i) { return CameraParameters(0.5 * CameraParameters::Unit(i)); });
  Judge();
  for (size_t i = 0; i < 2; ++i) {
    const CameraPrior& prior = set.photographs[i].prior;
    EXPECT_EQ(Of(i).verdict, Verdict::kAccepted);
    EXPECT_THAT(Of(i).reasons, IsEmpty());
    EXPECT_EQ(Of(i).num_samples, 40 + static_cast<int>(i));
    EXPECT_EQ(Of(i).corrected,
              TagFromParameters(prior.mean + 0.5 * prior.root.col(static_cast<Eigen::Index>(i)),
                                prior.measured));
    EXPECT_LT((Of(i).covariance - ClaimOf(i)).norm(), 1e-9 * ClaimOf(i).norm());
    EXPECT_GT(Of(i).score_nats, 100);
    EXPECT_FALSE(Of(i).margin_nats);
  }
}

TEST_F(JudgeMembersTest, WhatSpokeAgainstAPhotographByItselfIsForgotten) {
  MakeSet(2, AtTheTag);
  alignments[0].registration.verdict = Verdict::kReview;
  alignments[0].registration.reasons = {"another camera fits almost as well"};
  Judge();
  EXPECT_EQ(Of(0).verdict, Verdict::kAccepted);
  EXPECT_THAT(Of(0).reasons, IsEmpty());
}

TEST_F(JudgeMembersTest, WhoseEdgesAreNotWhereItsCameraSeesThemIsRejectedAlone) {
  MakeSet(2, AtTheTag);
  for (ScoreSample& sample : set.photographs[1].score_samples) sample.candidates.clear();
  Judge();
  EXPECT_EQ(Of(0).verdict, Verdict::kAccepted);
  EXPECT_EQ(Of(1).verdict, Verdict::kRejected);
  EXPECT_THAT(Of(1).reasons, ElementsAre(HasSubstr("no better than by chance")));
}

TEST_F(JudgeMembersTest, EdgesAreLookedForWhereTheCommonSolutionHasMovedThem) {
  MakeSet(2, AtTheTag);
  set.edge_moves_in_world.assign(edge_model.edges.size(), Eigen::Vector3d(0, 0, 2));
  Judge();
  const double moved_nats = Of(0).score_nats;
  set.edge_moves_in_world.clear();
  Judge();
  EXPECT_LT(moved_nats, 0.5 * Of(0).score_nats);
}

// Of two walls either may be the misplaced one (AlignedPhotograph::doubt): x may be 2 ft off.
TEST_F(JudgeMembersTest, DoubtWidensWhatIsClaimed) {
  MakeSet(2, AtTheTag);
  set.photographs[1].doubt(kPositionX, kPositionX) = 4;
  Judge();
  CameraCovariance expected = ClaimOf(1);
  EXPECT_LT((Of(0).covariance - ClaimOf(0)).norm(), 1e-9 * ClaimOf(0).norm());
  expected(kPositionX, kPositionX) += 4;
  EXPECT_LT((Of(1).covariance - expected).norm(), 1e-6);
  EXPECT_NEAR(Of(1).sigmas[kPositionX], std::sqrt(expected(kPositionX, kPositionX)), 1e-6);
  EXPECT_THAT(Of(0).undetermined, IsEmpty());
  EXPECT_THAT(Of(1).undetermined, ElementsAre("x"));
  EXPECT_EQ(JudgePrecision(Of(0), options.verdict).verdict, Verdict::kAccepted);
  EXPECT_EQ(JudgePrecision(Of(1), options.verdict).verdict, Verdict::kReview);
}

TEST_F(JudgeMembersTest, ACameraElsewhereThatFitsAlmostAsWellIsToldWithItsTag) {
  MakeSet(2, AtTheTag);
  const CameraParameters apart = 3 * Towards(kYaw, PriorOf(1));
  const double distance_px = DistancePx(1, apart);
  ASSERT_GT(distance_px * 640 / kSmallWidth, options.verdict.max_vertex_sigma_px);
  CameFrom(1, apart, 5);
  alignments[1].registration.width_px = 2 * kSmallWidth;  // the photograph's own pixels
  Judge();
  EXPECT_EQ(Of(0).verdict, Verdict::kAccepted);
  EXPECT_EQ(Of(1).verdict, Verdict::kReview);
  char in_photograph[32];
  std::snprintf(in_photograph, sizeof in_photograph, "%.1f px away", 2 * distance_px);
  EXPECT_THAT(Of(1).reasons, ElementsAre(HasSubstr(in_photograph)));
  EXPECT_NEAR(*Of(1).margin_nats, 5, 1e-6);
  const CameraPrior& prior = set.photographs[1].prior;
  EXPECT_EQ(Of(1).rival, TagFromParameters(prior.ParametersAt(apart), prior.measured));
  EXPECT_LT((Of(1).covariance - ClaimOf(1)).norm(), 1e-9 * ClaimOf(1).norm());
}

TEST_F(JudgeMembersTest, OneAsNearAsCamerasMustBeKnownIsCoveredByTheClaim) {
  MakeSet(2, AtTheTag);
  CameraParameters apart = 0.1 * Towards(kYaw, PriorOf(1));
  // 1.7 px at a width of 640, where 2 px are asked for; from 1.3 px on they are two places.
  apart *= 0.8 / DistancePx(1, apart);
  CameFrom(1, apart, 5);
  options.verdict.min_margin_nats = 20;
  options.verdict.min_margin_per_observation = 0;
  Judge();
  EXPECT_EQ(Of(1).verdict, Verdict::kAccepted);
  // 5 nats of the 20 that are asked for: half of three quarters of the way's square.
  const CameraParameters way = set.photographs[1].prior.root * apart;
  const CameraCovariance expected = ClaimOf(1) + 0.375 * way * way.transpose();
  EXPECT_LT((Of(1).covariance - expected).norm(), 1e-6 * expected.norm());
  EXPECT_GT(0.375 * way[kYaw] * way[kYaw], 0.01 * ClaimOf(1)(kYaw, kYaw)) << "it can be seen";
}

// Six pages that lie 1.6 of a tape's standard deviations east or west of their cameras.
struct JudgeTagsOfMembersTest : JudgeMembersTest {
  JudgeTagsOfMembersTest() {
    MakeSet(6, [](size_t i) {
      return CameraParameters((i % 2 == 0 ? 1.6 : -1.6) * Towards(kPositionX, PriorOf(i)));
    });
  }

  // The page claims so many times less than a tape errs by; its camera stays where it is.
  void ClaimTooMuch(size_t i, double times) {
    AlignedPhotograph& photograph = set.photographs[i];
    const CameraParameters parameters = photograph.prior.ParametersAt(photograph.whitened);
    photograph.prior = photograph.written = WithWiderPose(photograph.prior, 1 / times);
    photograph.whitened = joint.photographs[i].whitened = photograph.prior.WhitenedAt(parameters);
  }
};

TEST_F(JudgeTagsOfMembersTest, WhereANotebookClaimsTooMuchATagIsHeldToWhatItErrsBy) {
  // 3.84 of what they claim, where 3.5 are allowed.
  for (size_t i = 0; i < 6; ++i) ClaimTooMuch(i, 2.4);
  Judge();
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(Of(i).verdict, Verdict::kAccepted) << i;
    EXPECT_THAT(Of(i).reasons, IsEmpty()) << i;
  }
  // Where too few pages tell of the others, each is a blunder.
  options.overclaim.least_photographs_of_set = 7;
  Judge();
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(Of(i).verdict, Verdict::kReview) << i;
    EXPECT_THAT(Of(i).reasons,
                ElementsAre(AllOf(HasSubstr("other than written: x "),
                                  HasSubstr("; 3.8 times what the tag's sigmas claim"))))
        << i;
  }
}

TEST_F(JudgeTagsOfMembersTest, OnePageThatClaimsTooMuchIsABlunder) {
  ClaimTooMuch(3, 2.4);
  Judge();
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(Of(i).verdict, i == 3 ? Verdict::kReview : Verdict::kAccepted) << i;
  }
}

TEST_F(JudgeTagsOfMembersTest, ASlipHasNoVoteOnTheNotebook) {
  options.overclaim.least_photographs_of_set = 6;
  for (size_t i = 0; i < 6; ++i) ClaimTooMuch(i, 2.4);
  set.photographs[5].slip = "k 19.9 (another digit)";
  Judge();
  // The five others are too few to tell.
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_THAT(Of(i).reasons, ElementsAre(HasSubstr("other than written: x "))) << i;
  }
  EXPECT_EQ(Of(5).verdict, Verdict::kReview);
  EXPECT_THAT(Of(5).reasons, ElementsAre(HasSubstr("with k 19.9 (another digit)")));
}

// 30 of 100 places that each of three others seeks agree; of its own 40, none.
TEST_F(JudgeMembersTest, WhoSharesNothingWhereTheOthersDoIsReviewed) {
  MakeSet(4, AtTheTag);
  for (size_t i = 0; i < 3; ++i) alignments[i].registration.ties = {100, 30, 60};
  alignments[3].registration.ties = {40, 0, -4};
  Judge();
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(Of(i).verdict, Verdict::kAccepted) << i;
  EXPECT_EQ(Of(3).verdict, Verdict::kReview);
  EXPECT_THAT(Of(3).reasons,
              ElementsAre(HasSubstr("of 40 places that they could share, 0 agree, "
                                    "where 12 should")));
}

}  // namespace
}  // namespace groundglass
