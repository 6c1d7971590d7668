// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_samples.h"

#include "tests/register/photographs_of_house.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace groundglass {
namespace {

constexpr double kMarginPx = -3;
constexpr double kSpacingPx = 4;

struct SampleVisibleEdgesTest : testing::Test {
  PolygonModel model = MakeHouse();
  EdgeModel edge_model{model};
  Camera camera = CameraFromTag(TrueTagsOfHouse()[1], kSmallWidth, kSmallHeight);

  std::vector<EdgeSample> Sample() const {
    return SampleVisibleEdges(edge_model, camera, kMarginPx, kSpacingPx);
  }

  // Moves the plane that has this normal, and all edges whose ends hold for `is_on_plane`, by so
  // much along the normal.
  template <typename IsOnPlane>
  void MovePlane(const Eigen::Vector3d& normal_in_world,
                 double offset_units,
                 IsOnPlane is_on_plane) {
    edge_model.group_offsets.assign(edge_model.groups.num_numbers.size(), Eigen::Vector2d::Zero());
    std::set<int> moved;
    for (size_t edge = 0; edge < edge_model.edges.size(); ++edge) {
      const ModelEdge& ends = edge_model.edges[edge];
      if (!is_on_plane(ends.start_in_world) || !is_on_plane(ends.end_in_world)) continue;
      for (const EdgeGroupPart& part : edge_model.groups.of_edge[edge]) {
        const double towards = part.directions.col(0).dot(normal_in_world);
        // Of two planes that meet, one moves the line along the other.
        if (std::abs(std::abs(towards) - 1) > 1e-9 || !moved.insert(part.group).second) continue;
        edge_model.group_offsets[part.group][0] = offset_units * towards;
      }
    }
    ASSERT_EQ(moved.size(), 1u);
  }

  // What the samples are, moved and as they were, but for where they stand.
  void ExpectTheSameBut(const std::vector<EdgeSample>& before,
                        const std::vector<EdgeSample>& after) const {
    ASSERT_EQ(after.size(), before.size());
    for (size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(after[i].edge, before[i].edge);
      EXPECT_EQ(after[i].along, before[i].along);
      EXPECT_EQ(after[i].spacing_px, before[i].spacing_px);
      EXPECT_EQ(after[i].direction_in_world, before[i].direction_in_world);
      EXPECT_EQ(after[i].tolerance, before[i].tolerance);
    }
  }
};

TEST_F(SampleVisibleEdgesTest, StandEverySpacingOnTheirEdgesAndInTheFrame) {
  const std::vector<EdgeSample> samples = Sample();
  ASSERT_GT(samples.size(), 100u);
  for (const EdgeSample& sample : samples) {
    const ModelEdge& edge = edge_model.edges[sample.edge];
    const Eigen::Vector3d expected = (edge.start_in_world + edge.end_in_world) / 2 +
                                     sample.along * (edge.end_in_world - edge.start_in_world) / 2;
    EXPECT_LT((sample.point_in_world - expected).norm(), 1e-9);
    // As many as fit: of two spacings or more, none is half a spacing wider.
    EXPECT_GE(sample.spacing_px, kSpacingPx);
    EXPECT_LT(sample.spacing_px, 1.5 * kSpacingPx);
    const auto at_px = Project(camera, sample.point_in_world);
    ASSERT_TRUE(at_px);
    EXPECT_GT(at_px->minCoeff(), -kMarginPx);
    EXPECT_LT(at_px->x(), kSmallWidth + kMarginPx);
    EXPECT_LT(at_px->y(), kSmallHeight + kMarginPx);
  }
}

TEST_F(SampleVisibleEdgesTest, TheNorthWallIsHiddenFromTheSouth) {
  for (const EdgeSample& sample : Sample()) {
    const ModelEdge& edge = edge_model.edges[sample.edge];
    EXPECT_FALSE(edge.start_in_world.y() == 20 && edge.end_in_world.y() == 20) << sample.edge;
  }
}

TEST_F(SampleVisibleEdgesTest, ALevelThatIsMovedTakesItsEdgesAlongAndNoOthers) {
  const std::vector<EdgeSample> before = Sample();
  MovePlane(Eigen::Vector3d::UnitZ(), 0.7, [](const auto& point) { return point.z() == 8; });
  const std::vector<EdgeSample> after = Sample();
  ExpectTheSameBut(before, after);
  int num_moved = 0;
  for (size_t i = 0; i < after.size(); ++i) {
    const ModelEdge& edge = edge_model.edges[after[i].edge];
    // The lean-to's roof; no other edge lies on that level.
    const bool is_moved = edge.start_in_world.z() == 8 && edge.end_in_world.z() == 8;
    num_moved += is_moved;
    const Eigen::Vector3d move(0, 0, is_moved ? 0.7 : 0);
    EXPECT_LT((after[i].point_in_world - before[i].point_in_world - move).norm(), 1e-9)
        << after[i].edge;
  }
  EXPECT_GT(num_moved, 10);
}

// Where the wall meets the roof (8 ft up in 10) the line goes with the wall, down along the roof:
// by (0, -0.5, -0.4), less what a damping of 0.05 takes (MovesOfIntersection).
TEST_F(SampleVisibleEdgesTest, AWallThatIsMovedTakesItsEavesAlongTheRoof) {
  const std::vector<EdgeSample> before = Sample();
  MovePlane(-Eigen::Vector3d::UnitY(), 0.5, [](const auto& point) { return point.y() == 0; });
  const std::vector<EdgeSample> after = Sample();
  ExpectTheSameBut(before, after);
  int num_eaves = 0;
  for (size_t i = 0; i < after.size(); ++i) {
    const ModelEdge& edge = edge_model.edges[after[i].edge];
    const bool is_on_wall = edge.start_in_world.y() == 0 && edge.end_in_world.y() == 0;
    const bool is_eave = is_on_wall && edge.start_in_world.z() == 16 && edge.end_in_world.z() == 16;
    num_eaves += is_eave;
    Eigen::Vector3d move(0, is_on_wall ? -0.5 : 0, 0);
    if (is_eave) move = {0, -0.48630, -0.35956};
    EXPECT_LT((after[i].point_in_world - before[i].point_in_world - move).norm(), 1e-4)
        << after[i].edge;
  }
  EXPECT_GT(num_eaves, 10);
}

// However far it is moved: what is hidden was decided by the model as it is drawn.
TEST_F(SampleVisibleEdgesTest, AMovedEdgeIsSeenWhereTheDrawnOneWouldBe) {
  const std::vector<EdgeSample> before = Sample();
  MovePlane(Eigen::Vector3d::UnitZ(), -500, [](const auto& point) { return point.z() == 8; });
  ExpectTheSameBut(before, Sample());
}

TEST_F(SampleVisibleEdgesTest, MovesOfAllEdgesAreNoneWhereNoGroupIsMoved) {
  EXPECT_TRUE(edge_model.MovesInWorld().empty());
  MovePlane(Eigen::Vector3d::UnitZ(), 0.7, [](const auto& point) { return point.z() == 8; });
  const std::vector<Eigen::Vector3d> moves = edge_model.MovesInWorld();
  ASSERT_EQ(moves.size(), edge_model.edges.size());
  for (size_t edge = 0; edge < moves.size(); ++edge) {
    EXPECT_EQ(moves[edge], edge_model.MoveOf(static_cast<int>(edge)));
  }
}

}  // namespace
}  // namespace groundglass
