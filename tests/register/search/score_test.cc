// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/search/score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

// A camera at (0, -100, 0) in world that looks north; the origin is seen at (300, 200).
ParameterProjection Projection() {
  ViewTag tag;
  tag.position_in_site = {0, 100, 0};
  tag.lookat_in_site = {0, 0, 0};
  return ParameterProjection(ParametersFromTag(tag), {}, 600, 400);
}

// A sample of a horizontal edge through the origin, of two observations, with an edge of the
// picture this far below it.
ScoreSample SampleAt(double offset_px, double strength = 8) {
  ScoreSample sample;
  sample.edge = 0;
  sample.observations = 2;
  sample.origin_px = {300, 200};
  sample.normal = {0, 1};
  sample.range_px = 12;
  sample.candidates = {{offset_px, strength}};
  return sample;
}

TEST(ScoreFromSamples, AnEdgeThatMeetsIsBetterThanChanceAndOneThatMissesIsWorse) {
  const AlignmentScore meets = ScoreFromSamples({SampleAt(0)}, Projection(), {});
  EXPECT_EQ(meets.observations, 2);
  EXPECT_GT(meets.nats, 0);
  const AlignmentScore misses = ScoreFromSamples({SampleAt(11)}, Projection(), {});
  EXPECT_LT(misses.nats, 0);
}

TEST(ScoreFromSamples, IsTheLogarithmOfHowMuchLikelierTheEdgeIsThanClutter) {
  // The candidates of the place are its clutter: one in 24 px where there is one.
  ScoreOptions options;
  const double at_its_place = ScoreFromSamples({SampleAt(0)}, Projection(), options).nats;
  const double a_sigma_off = ScoreFromSamples({SampleAt(1)}, Projection(), options).nats;
  EXPECT_GT(at_its_place, a_sigma_off);
  options.shown_share = 0.01;  // hardly an edge is shown: neither says much
  EXPECT_LT(std::abs(ScoreFromSamples({SampleAt(0)}, Projection(), options).nats),
            0.2 * std::abs(at_its_place));
}

TEST(ScoreFromSamples, APlaceFullOfEdgesSaysLess) {
  ScoreSample crowded = SampleAt(0);
  for (int i = -11; i <= 11; ++i) {
    if (i != 0) crowded.candidates.push_back({static_cast<double>(i), 8});
  }
  EXPECT_LT(ScoreFromSamples({crowded}, Projection(), {}).nats,
            ScoreFromSamples({SampleAt(0)}, Projection(), {}).nats);
}

TEST(ScoreFromSamples, WhatLiesBehindTheCameraIsNoObservation) {
  ScoreSample behind = SampleAt(0);
  behind.point_in_world = {0, -200, 0};
  EXPECT_EQ(ScoreFromSamples({behind}, Projection(), {}).observations, 0);
}

TEST(WithEdgesMoved, AnEdgeIsScoredWhereItIsTakenToBe) {
  // A foot higher at 100 ft; samples ask along normals that point down.
  const double px_per_foot =
      (Projection().ImageOf({0, 0, 0})->y() - Projection().ImageOf({0, 0, 1})->y());
  const std::vector<ScoreSample> samples = {SampleAt(-px_per_foot)};
  const std::vector<ScoreSample> moved = WithEdgesMoved(samples, {Eigen::Vector3d(0, 0, 1)});
  EXPECT_NEAR(ScoreFromSamples(moved, Projection(), {}).nats,
              ScoreFromSamples({SampleAt(0)}, Projection(), {}).nats,
              0.01);
  EXPECT_EQ(WithEdgesMoved(samples, {}).front().point_in_world, samples.front().point_in_world);
}

}  // namespace
}  // namespace groundglass
