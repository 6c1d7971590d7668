// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_evidence.h"

#include "scene/reduce.h"
#include "scene/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

// A straight border between two greys at n . p = offset, exact to subpixels: each pixel shows the
// mean of the light that falls on it.
Image8 StepImage(const Eigen::Vector2d& normal, double offset_px) {
  Image8 image(120, 100, 1);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      double bright = 0;
      for (int i = 0; i < 64; ++i) {
        const int row = i / 8;
        const Eigen::Vector2d at(x + (i % 8 + 0.5) / 8, y + (row + 0.5) / 8);
        bright += normal.dot(at) > offset_px;
      }
      const double light =
          std::lerp(LinearFromSrgb(60 / 255.0f), LinearFromSrgb(180 / 255.0f), bright / 64);
      *image.At(x, y) =
          static_cast<uint8_t>(255 * SrgbFromLinear(static_cast<float>(light)) + 0.5f);
    }
  }
  return image;
}

TEST(EdgeEvidence, FindsAStepToATwentiethOfAPixel) {
  for (const double turn_deg : {0.0, 20.0, 45.0, 77.0, 90.0, 140.0}) {
    const double turn = turn_deg / 57.29577951308232;
    const Eigen::Vector2d normal(std::cos(turn), std::sin(turn));
    const Eigen::Vector2d sample(60.3, 50.1);
    const double truth_px = 1.37;
    const EdgeEvidence evidence(StepImage(normal, normal.dot(sample) + truth_px), {});
    const auto candidates = evidence.FindCandidates(sample, normal, 6, 8, 25);
    ASSERT_EQ(candidates.size(), 1u) << turn_deg;
    EXPECT_NEAR(candidates[0].offset_px, truth_px, 0.05) << turn_deg;
    EXPECT_GT(candidates[0].strength, 0) << "brighter along the normal";
  }
}

// A border blurred by optics, which blur light: in the photograph's codes its steepest place lies
// 0.2 px towards the dark side, here 0.3 px.
TEST(EdgeEvidence, ABlurredStepLiesWhereTheLightChangesMost) {
  constexpr double kBlur = 1.2;  // px
  Image8 image(120, 100, 1);
  for (int x = 0; x < image.width; ++x) {
    const double bright = 0.5 * std::erfc((60.25 - (x + 0.5)) / (kBlur * std::sqrt(2.0)));
    const auto light = static_cast<float>(std::lerp(0.02, 0.7, bright));
    for (int y = 0; y < image.height; ++y) {
      *image.At(x, y) = static_cast<uint8_t>(255 * SrgbFromLinear(light) + 0.5f);
    }
  }
  const EdgeEvidence evidence(image, {});
  for (const double side : {1.0, -1.0}) {
    const auto candidates = evidence.FindCandidates({60, 50}, {side, 0}, 6, 8, 25);
    ASSERT_EQ(candidates.size(), 1u);
    EXPECT_NEAR(side * candidates[0].offset_px, 0.25, 0.03);
  }
}

// Photographs wider than registration works at are reduced first: in light, so that the border
// stays where it is. The codes' mean would move it by a tenth of a pixel towards its dark side.
TEST(EdgeEvidence, ABorderOfALargePhotographStaysWhereItIsWhenReduced) {
  constexpr double kBlur = 2.4;  // px of the large photograph
  for (const double border_px : {240.6, 241.3, 242.1}) {
    Image8 image(480, 400, 1);
    for (int x = 0; x < image.width; ++x) {
      const double bright = 0.5 * std::erfc((border_px - (x + 0.5)) / (kBlur * std::sqrt(2.0)));
      const auto light = static_cast<float>(std::lerp(0.01, 0.8, bright));
      for (int y = 0; y < image.height; ++y) {
        *image.At(x, y) = static_cast<uint8_t>(255 * SrgbFromLinear(light) + 0.5f);
      }
    }
    const EdgeEvidence evidence(ReducedInLight(image, 120, 100), {});
    const auto candidates = evidence.FindCandidates({60, 50}, {1, 0}, 6, 8, 25);
    ASSERT_EQ(candidates.size(), 1u);
    EXPECT_NEAR(60 + candidates[0].offset_px, border_px / 4, 0.03);
  }
}

TEST(EdgeEvidence, AWideSearchFindsTheSameStepOnACoarserScale) {
  const Eigen::Vector2d normal(1, 0);
  const Eigen::Vector2d sample(60, 50);
  const EdgeEvidence evidence(StepImage(normal, 84.0), {});
  const auto candidates = evidence.FindCandidates(sample, normal, 40, 8, 25);
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_NEAR(candidates[0].offset_px, 24, 0.5);
}

TEST(EdgeEvidence, TheGateKeepsOutEdgesThatRunAcross) {
  const double turn = 40 / 57.29577951308232;
  const EdgeEvidence evidence(StepImage({std::cos(turn), std::sin(turn)}, 80), {});
  EXPECT_TRUE(evidence.FindCandidates({60, 52}, {1, 0}, 10, 8, 25).empty());
  EXPECT_FALSE(evidence.FindCandidates({60, 52}, {1, 0}, 10, 8, 60).empty());
}

TEST(EdgeEvidence, WhatIsMaskedIsNoEvidence) {
  Image8 ignore(120, 100, 1);
  for (int y = 0; y < 100; ++y) {
    for (int x = 50; x < 80; ++x) *ignore.At(x, y) = 1;
  }
  const EdgeEvidence evidence(StepImage({1, 0}, 61), ignore);
  EXPECT_TRUE(evidence.FindCandidates({60, 50}, {1, 0}, 6, 8, 25).empty());
}

TEST(EdgeEvidence, AFlatPhotographHasNoEdges) {
  const EdgeEvidence evidence(Image8(120, 100, 1, 128), {});
  EXPECT_TRUE(evidence.FindCandidates({60, 50}, {1, 0}, 20, 8, 25).empty());
}

}  // namespace
}  // namespace groundglass
