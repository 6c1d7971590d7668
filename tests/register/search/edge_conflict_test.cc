// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/search/edge_conflict.h"

#include "tests/support/spoilt_options.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

constexpr double kWidthPx = 600;

// A camera at (0, -100, 0) in world that looks north; the origin is seen at (300, 200).
ParameterProjection LooksNorth() {
  ViewTag tag;
  tag.position_in_site = {0, 100, 0};
  tag.lookat_in_site = {0, 0, 0};
  return ParameterProjection(ParametersFromTag(tag), {}, 600, 400);
}

// A drawing of level and upright edges: the building's own first, then as many drawn onto walls.
struct Drawing {
  std::vector<ModelEdge> edges;
  std::vector<ScoreSample> samples;
};

constexpr int kEdgesOfPart = 10;

// own_px, drawn_px: where the picture shows each part, from where the camera sees it.
Drawing DrawingShownAt(const Eigen::Vector2d& own_px, const Eigen::Vector2d& drawn_px) {
  Drawing drawing;
  for (const bool is_coplanar : {false, true}) {
    for (int i = 0; i < kEdgesOfPart; ++i) {
      ModelEdge edge;
      edge.kind = is_coplanar ? ModelEdge::Kind::kCoplanar : ModelEdge::Kind::kCrease;
      ScoreSample sample;
      sample.edge = static_cast<int>(drawing.edges.size());
      sample.observations = 3;
      sample.origin_px = {300, 200};
      sample.normal = i % 2 == 0 ? Eigen::Vector2d::UnitX() : Eigen::Vector2d::UnitY();
      sample.range_px = 12;
      sample.candidates = {{sample.normal.dot(is_coplanar ? drawn_px : own_px), 8}};
      drawing.edges.push_back(edge);
      drawing.samples.push_back(sample);
    }
  }
  return drawing;
}

std::optional<EdgeConflict> ConflictOf(const Drawing& drawing,
                                       const ConflictOptions& options = {}) {
  return FindEdgeConflict(
      drawing.samples, drawing.edges, LooksNorth(), kWidthPx, ScoreOptions(), options);
}

TEST(FindEdgeConflict, PartsThatAgreeHaveNone) {
  EXPECT_FALSE(ConflictOf(DrawingShownAt({0, 0}, {0, 0})));
}

TEST(FindEdgeConflict, OutlinesThatLieElsewhereAreTold) {
  const std::optional<EdgeConflict> conflict = ConflictOf(DrawingShownAt({6, 2}, {0, 0}));
  ASSERT_TRUE(conflict);
  EXPECT_FALSE(conflict->is_of_coplanar_edges);
  EXPECT_NEAR(conflict->distance_px, std::hypot(6, 2), 0.01);
  EXPECT_GT(conflict->gain_nats, 30);
}

TEST(FindEdgeConflict, SoAreLinesOnWalls) {
  const std::optional<EdgeConflict> conflict = ConflictOf(DrawingShownAt({0, 0}, {-5, 3}));
  ASSERT_TRUE(conflict);
  EXPECT_TRUE(conflict->is_of_coplanar_edges);
  EXPECT_NEAR(conflict->distance_px, std::hypot(5, 3), 0.01);
}

TEST(FindEdgeConflict, ItsLimitsAreTheOptions) {
  const Drawing near = DrawingShownAt({2, 0}, {0, 0});
  EXPECT_FALSE(ConflictOf(near));
  EXPECT_TRUE(ConflictOf(near, {.least_distance_share = 0.002, .least_gain_nats = 5}));
  const Drawing far = DrawingShownAt({6, 2}, {0, 0});
  EXPECT_FALSE(ConflictOf(far, {.least_gain_nats = 1000}));
  EXPECT_FALSE(ConflictOf(far, {.reach_share = 0.005, .least_distance_share = 0.004}));
}

TEST(FindEdgeConflict, OnePartAloneHasNothingToDisagreeWith) {
  Drawing drawing = DrawingShownAt({6, 2}, {0, 0});
  drawing.samples.resize(kEdgesOfPart);
  EXPECT_FALSE(ConflictOf(drawing));
}

TEST(ConflictOptions, CheckNamesEachField) {
  [[maybe_unused]] const auto& [reach, distance, step, gain, observations, share] =
      ConflictOptions();
  ExpectCheckNamesEach<ConflictOptions>({
      {"reach_share", [](auto& o) { o.reach_share = 0; }},
      {"least_distance_share", [](auto& o) { o.least_distance_share = -1; }},
      {"step_px", [](auto& o) { o.step_px = 0; }},
      {"least_gain_nats", [](auto& o) { o.least_gain_nats = 0; }},
      {"least_observations", [](auto& o) { o.least_observations = kNotANumber; }},
      {"least_share", [](auto& o) { o.least_share = 2; }},
  });
}

}  // namespace
}  // namespace groundglass
