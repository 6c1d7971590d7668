// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/verdict.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

Registration Judged(const Evidence& evidence) {
  Registration registration;
  registration.verdict = Verdict::kAccepted;
  JudgeEvidence(evidence, {}, registration);
  return registration;
}

TEST(JudgeEvidence, WithoutARivalThereIsNoMarginAndNothingAgainstIt) {
  const Registration registration = Judged({{400, 300}, std::nullopt, 0});
  EXPECT_EQ(registration.verdict, Verdict::kAccepted);
  EXPECT_EQ(registration.score_nats, 400);
  EXPECT_FALSE(registration.margin_nats.has_value());
}

TEST(JudgeEvidence, ARivalThatFitsAlmostAsWellIsReviewed) {
  const Registration registration = Judged({{400, 300}, 30, 7.5});
  EXPECT_EQ(registration.verdict, Verdict::kReview);
  EXPECT_EQ(registration.margin_nats, 30);
  ASSERT_EQ(registration.reasons.size(), 1u);
  EXPECT_EQ(registration.reasons[0], "a rival 7.5 px away fits almost as well (margin 30 nats)");
  EXPECT_EQ(Judged({{400, 300}, 46, 7.5}).verdict, Verdict::kAccepted);
}

TEST(JudgeEvidence, NoBetterThanChanceIsRejected) {
  EXPECT_EQ(Judged({{-3, 300}, std::nullopt, 0}).verdict, Verdict::kRejected);
  EXPECT_EQ(Judged({{30, 300}, std::nullopt, 0}).verdict, Verdict::kReview);
}

TEST(JudgeOutcome, WhatTheSolverCouldNotDoIsAVerdictWithItsReason) {
  using Outcome = Refinement::Outcome;
  const std::pair<Outcome, Verdict> expected[] = {{Outcome::kConverged, Verdict::kAccepted},
                                                  {Outcome::kNotSettled, Verdict::kReview},
                                                  {Outcome::kNoCovariance, Verdict::kReview},
                                                  {Outcome::kNoSolution, Verdict::kRejected},
                                                  {Outcome::kTooFewEdges, Verdict::kReview}};
  for (const auto& [outcome, verdict] : expected) {
    Registration registration;
    registration.verdict = Verdict::kAccepted;
    JudgeOutcome(outcome, registration);
    EXPECT_EQ(registration.verdict, verdict);
    EXPECT_EQ(registration.reasons.empty(), verdict == Verdict::kAccepted);
  }
}

}  // namespace
}  // namespace groundglass
