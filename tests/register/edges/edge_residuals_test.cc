// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_residuals.h"

#include "scene/frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace groundglass {
namespace {

// At the origin, level, looking north, 90 degrees wide on 200 x 200 px: f = 100, centre at 100.
ParameterProjection Camera90() {
  CameraParameters parameters = CameraParameters::Zero();
  parameters[kYaw] = 90;
  parameters[kViewAngle] = 90;
  parameters[kAspect] = 1;
  return {parameters, {}, 200, 200};
}

TEST(EdgeResiduals, AreFromThePhotographsEdgeToTheModelsAlongTheNormal) {
  AlignedSample seen;
  seen.edge = 3;
  seen.along = 0.5;
  seen.point_in_world = {1, 10, 0};  // 10 px right of the centre
  seen.origin_px = {106, 80};
  seen.offset_px = 1.5;
  seen.precision = 4;
  AlignedSample behind = seen;
  behind.point_in_world = {1, -10, 0};
  const std::vector<SampleResidual> residuals =
      ResidualsOf(std::vector<AlignedSample>{seen, behind}, Camera90());
  ASSERT_EQ(residuals.size(), 1);
  EXPECT_EQ(residuals[0].edge, 3);
  EXPECT_EQ(residuals[0].along, 0.5);
  EXPECT_EQ(residuals[0].precision, 4);
  EXPECT_NEAR(residuals[0].image_px.x(), 110, 1e-9);
  EXPECT_NEAR(residuals[0].residual_px, 110 - 106 - 1.5, 1e-9);
}

TEST(EdgeResiduals, OfNoneThereIsNoSpread) {
  EXPECT_FALSE(SpreadOf({}));
  const std::vector<SampleResidual> two = {{0, 0, {0, 0}, {1, 0}, 0.3, 1},
                                           {0, 1, {9, 0}, {1, 0}, -0.3, 1}};
  EXPECT_NEAR(SpreadOf(two)->rms_px, 0.3, 1e-12);
}

TEST(EdgeResiduals, PiecesOfAnEdgeAreWeightedMeansWithoutOutliers) {
  const Eigen::Vector2d down = Eigen::Vector2d::UnitY();
  const std::vector<SampleResidual> residuals = {
      {1, -1.0, {0, 50}, down, 7, 1},  // another edge
      {0, 0.2, {12, 10}, down, 1, 1},  // the first edge's second piece
      {0, -1.0, {0, 10}, down, 2, 3},  // and its first: (3 x 2 + 1 x -2) / 4
      {0, -0.6, {4, 10}, down, -2, 1},
      {0, -0.5, {5, 10}, down, 90, 0}};  // an outlier
  const std::vector<EdgeResidual> means = MeanResiduals(residuals, 10, 2);
  ASSERT_EQ(means.size(), 3);
  EXPECT_EQ(means[0].image_px, Eigen::Vector2d(2, 20));
  EXPECT_EQ(means[0].offset_px, Eigen::Vector2d(0, -2));
  EXPECT_EQ(means[1].image_px, Eigen::Vector2d(24, 20));
  EXPECT_EQ(means[1].offset_px, Eigen::Vector2d(0, -2));
  EXPECT_EQ(means[2].offset_px, Eigen::Vector2d(0, -14));
}

TEST(EdgeResiduals, NoneGiveNone) { EXPECT_TRUE(MeanResiduals({}, 10, 1).empty()); }

}  // namespace
}  // namespace groundglass
