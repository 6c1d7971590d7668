// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/covisible_pairs.h"

#include "tests/register/ties/wall.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

Pairs PairsOf(const PolygonModel& model, const std::vector<Camera>& cameras) {
  return FindCovisiblePairs(model, Visibility(model), cameras, {});
}

TEST(FindCovisiblePairs, AreThoseThatSeeTheSamePlaces) {
  // West end, middle and east end of the wall, from close by, without the ground.
  PolygonModel model = MakeWall();
  model.faces.resize(1);
  const std::vector<Camera> cameras = {
      CameraBeforeWall(4, 12, 4), CameraBeforeWall(13, 12, 13), CameraBeforeWall(36, 12, 36)};
  EXPECT_EQ(PairsOf(model, cameras), (Pairs{{0, 1}}));
}

TEST(FindCovisiblePairs, ACloseUpIsAPairWithTheWholeThatShowsIt) {
  const std::vector<Camera> cameras = {CameraBeforeWall(20, 60, 20), CameraBeforeWall(30, 6, 30)};
  EXPECT_EQ(PairsOf(MakeWall(), cameras), (Pairs{{0, 1}}));
}

TEST(FindCovisiblePairs, WhatStandsBeforeAPlaceHidesIt) {
  PolygonModel model = MakeWall();
  model.faces.resize(1);
  const std::vector<Camera> cameras = {CameraBeforeWall(10, 30, 20), CameraBeforeWall(30, 30, 20)};
  EXPECT_EQ(PairsOf(model, cameras), (Pairs{{0, 1}}));
  // A hoarding right before the second camera.
  const int first = static_cast<int>(model.points_in_world.size());
  model.points_in_world.insert(model.points_in_world.end(),
                               {{25, -28, 0}, {35, -28, 0}, {35, -28, 20}, {25, -28, 20}});
  model.faces.push_back({{first, first + 1, first + 2, first + 3}, "hoarding"});
  EXPECT_TRUE(PairsOf(model, cameras).empty());
}

TEST(FindCovisiblePairs, ACameraThatSeesNothingIsInNone) {
  const std::vector<Camera> cameras = {CameraBeforeWall(20, 40, 20), CameraBeforeWall(20, -40, 20)};
  EXPECT_TRUE(PairsOf(MakeWall(), cameras).empty());
}

}  // namespace
}  // namespace groundglass
