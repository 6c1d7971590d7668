// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/verdict/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(JudgeFit, WithoutASecondBestThereIsNothingAgainstIt) {
  const Judgement judgement = JudgeFit({{400, 300}, std::nullopt, 0}, {});
  EXPECT_EQ(judgement.verdict, Verdict::kAccepted);
  EXPECT_THAT(judgement.reasons, IsEmpty());
}

TEST(JudgeFit, ASecondBestThatFitsAlmostAsWellIsReviewed) {
  const Judgement judgement = JudgeFit({{400, 300}, 30, 7.5}, {});
  EXPECT_EQ(judgement.verdict, Verdict::kReview);
  EXPECT_THAT(judgement.reasons,
              ElementsAre("another camera 7.5 px away fits almost as well (margin 30 nats)"));
  EXPECT_EQ(JudgeFit({{400, 300}, 46, 7.5}, {}).verdict, Verdict::kAccepted);
}

TEST(JudgeFit, ASecondBestThatTheClaimCoversIsNone) {
  Evidence evidence{{400, 300}, 30, 1.5};
  evidence.claim_covers_both = true;
  EXPECT_EQ(JudgeFit(evidence, {}).verdict, Verdict::kAccepted);
}

TEST(JudgeTies, APhotographThatSharesNothingWhereOthersDoIsReviewed) {
  const Judgement judgement = JudgeTies({35, 0, -3.5}, {135, 33, 20}, {});
  EXPECT_EQ(judgement.verdict, Verdict::kReview);
  EXPECT_THAT(judgement.reasons,
              ElementsAre("other photographs do not confirm its camera: of 35 places that they "
                          "could share, 0 agree, where 12 should by what they share with one "
                          "another"));
  EXPECT_EQ(JudgeTies({35, 2, 2}, {135, 35, 20}, {}).verdict, Verdict::kAccepted);
}

// Where light or glass hide walls, or few places are sought, nothing follows.
TEST(JudgeTies, LittleThatIsExpectedSaysNothing) {
  EXPECT_EQ(JudgeTies({100, 0, -10}, {200, 4, 0}, {}).verdict, Verdict::kAccepted);
  EXPECT_EQ(JudgeTies({10, 0, -1}, {110, 50, 0}, {}).verdict, Verdict::kAccepted);
  EXPECT_EQ(JudgeTies({10, 0, -1}, {110, 50, 0}, {.min_expected_ties = 4}).verdict,
            Verdict::kReview);
}

TEST(JudgeConflict, PartsOfTheModelThatDisagreeAreReviewed) {
  const Judgement judgement = JudgeConflict({false, 10.2, 86}, 4, 6);
  EXPECT_EQ(judgement.verdict, Verdict::kReview);
  EXPECT_THAT(judgement.reasons,
              ElementsAre("the building's outlines and corners fit better 10.2 px from where the "
                          "rest of the model puts them (by 86 nats), and so in 4 of 6 photographs: "
                          "one part of the model is misplaced against the other"));
  EXPECT_THAT(JudgeConflict({true, 10.2, 86}, 4, 6).reasons,
              ElementsAre(HasSubstr("windows and other lines within walls fit better 10.2 px")));
}

TEST(JudgeFit, NoBetterThanChanceIsRejected) {
  EXPECT_EQ(JudgeFit({{-3, 300}, std::nullopt, 0}, {}).verdict, Verdict::kRejected);
  EXPECT_EQ(JudgeFit({{30, 300}, std::nullopt, 0}, {}).verdict, Verdict::kReview);
}

// A tag that looks into the sky: ten observations, of which two nats are better than chance.
TEST(JudgeFit, WhatChanceFindsAmongManyPlacesIsRejected) {
  const Judgement judgement = JudgeFit({{2, 9}, 0, 12.7}, {});
  EXPECT_EQ(judgement.verdict, Verdict::kRejected);
  EXPECT_THAT(judgement.reasons, Contains(HasSubstr("says next to nothing")));
  EXPECT_EQ(JudgeFit({{26, 40}, std::nullopt, 0}, {}).verdict, Verdict::kAccepted);
  // Where a person has pointed the place was not found by chance.
  EXPECT_EQ(JudgeFit({{2, 9}, std::nullopt, 0, true}, {}).verdict, Verdict::kAccepted);
  EXPECT_EQ(JudgeFit({{2, 9}, std::nullopt, 0}, {.min_nats = 1}).verdict, Verdict::kAccepted);
}

TEST(JudgeFit, ItsLimitsAreTheOptions) {
  VerdictOptions options;
  options.min_nats_per_observation = 0.05;
  EXPECT_EQ(JudgeFit({{30, 300}, std::nullopt, 0}, options).verdict, Verdict::kAccepted);
  options.min_margin_per_observation = 0;
  options.min_margin_nats = 29;
  EXPECT_EQ(JudgeFit({{400, 300}, 30, 7.5}, options).verdict, Verdict::kAccepted);
  options.min_margin_nats = 31;
  EXPECT_EQ(JudgeFit({{400, 300}, 30, 7.5}, options).verdict, Verdict::kReview);
}

TEST(JudgeConvergence, WhatTheSolverCouldNotDoIsAVerdictWithItsReason) {
  using Outcome = Refinement::Outcome;
  const std::pair<Outcome, Verdict> expected[] = {{Outcome::kConverged, Verdict::kAccepted},
                                                  {Outcome::kNotSettled, Verdict::kReview},
                                                  {Outcome::kNoCovariance, Verdict::kReview},
                                                  {Outcome::kNoSolution, Verdict::kRejected},
                                                  {Outcome::kTooFewEdges, Verdict::kReview}};
  for (const auto& [outcome, verdict] : expected) {
    const Judgement judgement = JudgeConvergence(outcome);
    EXPECT_EQ(judgement.verdict, verdict);
    EXPECT_EQ(judgement.reasons.empty(), verdict == Verdict::kAccepted);
  }
}

// Of parameters that do not depend on one another, sigma 2 each; the last is locked.
CameraPrior IndependentPrior() {
  CameraPrior prior;
  prior.sigmas.setConstant(2);
  prior.sigmas[kNumCameraParameters - 1] = 0;
  prior.root = prior.sigmas.asDiagonal();
  return prior;
}

// whitened: how far the camera lies from the prior's mean.
Judgement JudgeChange(const CameraParameters& whitened) {
  const CameraPrior prior = IndependentPrior();
  return JudgeInnovation(prior.ParametersAt(whitened), prior, LengthUnit::kFoot, {});
}

TEST(JudgeInnovation, AChangeWithinTheSigmasIsAccepted) {
  // Ten times 1.6 squared is 25.6, below 31.3; the locked one does not count.
  EXPECT_EQ(JudgeChange(CameraParameters::Constant(1.6)).verdict, Verdict::kAccepted);
}

TEST(JudgeInnovation, ManySmallChangesAreTooMuchTogether) {
  const Judgement judgement = JudgeChange(CameraParameters::Constant(1.8));
  EXPECT_EQ(judgement.verdict, Verdict::kReview);
  EXPECT_THAT(judgement.reasons, ElementsAre(HasSubstr("chi-squared 32 of 11")));
}

TEST(JudgeInnovation, ParametersThatMoveTooFarAreTold) {
  CameraParameters whitened = CameraParameters::Zero();
  whitened[kPositionZ] = 4;
  EXPECT_THAT(JudgeChange(whitened).reasons,
              ElementsAre("other than written: z 8 ft higher; 4.0 times what the tag's sigmas "
                          "claim"));
  whitened[kPositionY] = 5;  // north in `world`
  EXPECT_THAT(JudgeChange(whitened).reasons,
              ElementsAre("other than written: y 10 ft further north, z 8 ft higher; 5.0, 4.0 "
                          "times what the tag's sigmas claim"));
}

TEST(JudgeTag, WhatFitsAnotherReadingOnlyIsReviewed) {
  const CameraPrior prior = IndependentPrior();
  EXPECT_EQ(JudgeTag(prior.mean, prior, "", LengthUnit::kFoot, {}).verdict, Verdict::kAccepted);
  const Judgement slip = JudgeTag(prior.mean, prior, "x and y exchanged", LengthUnit::kFoot, {});
  EXPECT_EQ(slip.verdict, Verdict::kReview);
  EXPECT_THAT(slip.reasons, ElementsAre(HasSubstr("but with x and y exchanged")));
}

TEST(FindUndetermined, NamesWhatAPhotographDidNotNarrow) {
  CameraParameters sigmas = CameraParameters::Constant(1.0);
  sigmas[1] = 1.9;
  sigmas[kNumCameraParameters - 1] = 5;  // locked: not looked at
  EXPECT_THAT(FindUndetermined(sigmas, IndependentPrior(), {}), ElementsAre("y"));
  EXPECT_THAT(FindUndetermined(sigmas, IndependentPrior(), {.undetermined_share = 0.96}),
              IsEmpty());
}

TEST(JudgePrecision, CountsInPixelsAtAWidthOf640AndNamesTheLeastCertain) {
  Registration registration;
  registration.width_px = 1280;
  registration.vertex_sigma_px = 3.9;
  EXPECT_EQ(JudgePrecision(registration, {}).verdict, Verdict::kAccepted);
  registration.vertex_sigma_px = 4.1;
  registration.prior_sigmas.setOnes();
  registration.sigmas.setConstant(0.5);
  registration.sigmas[6] = 0.8;
  const Judgement judgement = JudgePrecision(registration, {});
  EXPECT_EQ(judgement.verdict, Verdict::kReview);
  EXPECT_THAT(judgement.reasons,
              ElementsAre("the model's points are known to 4.1 px only; v is the least certain"));
}

TEST(JudgeControlPoints, OneThatIsSeenElsewhereIsToldInThePhotographsPixels) {
  ViewTag tag;
  tag.position_in_site = {0, 100, 0};
  tag.lookat_in_site = {0, 0, 0};
  const ParameterProjection projection(ParametersFromTag(tag), {}, 600, 400);
  // The origin is seen in the middle.
  const ControlPoint right{"s1", {300, 203}, {0, 0, 0}, 1};
  const ControlPoint wrong{"s1", {300, 210}, {0, 0, 0}, 2};
  const ControlPoint behind{"s1", {300, 200}, {0, -200, 0}, 2};
  EXPECT_EQ(JudgeControlPoints({right}, projection, 0.5, {}).verdict, Verdict::kAccepted);
  const Judgement judgement = JudgeControlPoints({right, wrong, behind}, projection, 0.5, {});
  EXPECT_EQ(judgement.verdict, Verdict::kReview);
  EXPECT_THAT(judgement.reasons,
              ElementsAre("the control point at 600 420 is seen 20.0 px away, 5.0 of its sigmas",
                          "the control point at 600 400 is behind the camera"));
}

TEST(ApplyJudgement, LowersAndNeverRaises) {
  Registration registration;
  registration.verdict = Verdict::kReview;
  registration.reasons = {"first"};
  ApplyJudgement({}, registration);
  EXPECT_EQ(registration.verdict, Verdict::kReview);
  ApplyJudgement({Verdict::kRejected, {"second"}}, registration);
  ApplyJudgement({Verdict::kReview, {"third"}}, registration);
  EXPECT_EQ(registration.verdict, Verdict::kRejected);
  EXPECT_THAT(registration.reasons, ElementsAre("first", "second", "third"));
}

TEST(WithOverclaim, WidensWhatATagIsHeldToAndNothingElse) {
  const VerdictOptions usual;
  const VerdictOptions wide = WithOverclaim(usual, 2.4);
  EXPECT_DOUBLE_EQ(wide.max_prior_sigmas, 8.4);  // 3.5 sigmas
  EXPECT_DOUBLE_EQ(wide.max_prior_chi_squared, 31.3 * 5.76);
  EXPECT_EQ(wide.min_margin_per_observation, usual.min_margin_per_observation);
  EXPECT_EQ(wide.min_margin_nats, usual.min_margin_nats);
  EXPECT_EQ(wide.min_nats_per_observation, usual.min_nats_per_observation);
  EXPECT_EQ(wide.min_nats, usual.min_nats);
  EXPECT_EQ(wide.max_vertex_sigma_px, usual.max_vertex_sigma_px);
  EXPECT_EQ(wide.min_expected_ties, usual.min_expected_ties);
  EXPECT_EQ(wide.min_share_of_expected_ties, usual.min_share_of_expected_ties);
  EXPECT_EQ(wide.max_control_point_sigmas, usual.max_control_point_sigmas);
  EXPECT_EQ(wide.undetermined_share, usual.undetermined_share);
}

TEST(WithOverclaim, AChangeIsJudgedAsIfItsTagHadClaimedSoMuchLess) {
  const CameraPrior prior = IndependentPrior();
  const auto verdict_of = [&](const CameraParameters& whitened, double overclaim) {
    return JudgeInnovation(
               prior.ParametersAt(whitened), prior, LengthUnit::kFoot, WithOverclaim({}, overclaim))
        .verdict;
  };
  // One of them, 8.4 sigmas at the most; and all ten, whose squares are 180.3 at the most.
  for (const auto& [within, beyond] :
       {std::pair<CameraParameters, CameraParameters>{8.3 * CameraParameters::Unit(kYaw),
                                                      8.5 * CameraParameters::Unit(kYaw)},
        {CameraParameters::Constant(4.2), CameraParameters::Constant(4.3)}}) {
    EXPECT_EQ(verdict_of(within, 1), Verdict::kReview);
    EXPECT_EQ(verdict_of(within, 2.4), Verdict::kAccepted);
    EXPECT_EQ(verdict_of(beyond, 2.4), Verdict::kReview);
  }
}

}  // namespace
}  // namespace groundglass
