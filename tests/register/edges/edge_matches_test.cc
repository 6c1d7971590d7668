// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_matches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

double Normal(double x, double sigma) {
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2 * std::numbers::pi));
}

CandidateSample SampleWith(const std::vector<EdgeCandidate>& candidates) {
  CandidateSample sample;
  sample.sample.spacing_px = 20;  // one observation
  sample.candidates = candidates;
  return sample;
}

TEST(MatchCandidates, OneCandidateIsTheMatchAsFarAsItIsNoOutlier) {
  const MatchOptions options;
  const SoftAssignment match = MatchCandidates(SampleWith({{1, 10}}), 0, 6, 0.5, options);
  EXPECT_NEAR(match.offset_px, 1, 1e-12);
  // Width 2 = range / 3; 15 % outliers, spread over 12 px.
  const double right = 0.85 * Normal(1, 2);
  EXPECT_NEAR(match.precision, right / (right + 0.15 / 12) / 4, 1e-12);
}

TEST(MatchCandidates, TwoCandidatesAreWeighedByStrengthAndDistance) {
  const MatchOptions options;
  const SoftAssignment match =
      MatchCandidates(SampleWith({{1, 10}, {-3, -30}}), 0, 6, 0.5, options);
  const double near = 0.85 * 0.25 * Normal(1, 2);
  const double far = 0.85 * 0.75 * Normal(3, 2);
  EXPECT_NEAR(match.offset_px, (near - 3 * far) / (near + far), 1e-12);
}

TEST(MatchCandidates, OffsetsCountFromWhereTheEdgeIsPredicted) {
  const SoftAssignment match =
      MatchCandidates(SampleWith({{1, 10}, {9, 10}}), 9, 3, 0.5, MatchOptions());
  EXPECT_NEAR(match.offset_px, 9, 1e-12);
}

TEST(MatchCandidates, NothingInRangeHasNoPrecision) {
  EXPECT_EQ(MatchCandidates(SampleWith({{7, 10}}), 0, 6, 0.5, {}).precision, 0);
  EXPECT_EQ(MatchCandidates(SampleWith({}), 0, 6, 0.5, {}).precision, 0);
}

TEST(MatchCandidates, AShortPieceOfEdgeIsLessThanAVote) {
  CandidateSample sample = SampleWith({{1, 10}});
  const double whole = MatchCandidates(sample, 0, 6, 0.5, {}).precision;
  sample.sample.spacing_px = 5;
  EXPECT_NEAR(MatchCandidates(sample, 0, 6, 0.5, {}).precision, whole / 4, 1e-12);
}

}  // namespace
}  // namespace groundglass
