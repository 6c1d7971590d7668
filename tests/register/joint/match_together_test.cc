// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/match_together.h"

#include "register/refine/systematic_error.h"
#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

// Edges in the air that two photographs found so many of the model's sigmas away.
double SharedOffsetWhereEdgesLieOff(double sigmas) {
  const PolygonModel house = MakeHouse();
  const EdgeModel edge_model(house);
  const std::vector<AlignedPhotograph> photographs;
  const std::vector<TiePoint> ties;
  const JointOptions options;
  JointState state(edge_model, photographs, {}, ties, options);
  for (MovingEdge& edge : state.edges) {
    edge.frame.across.col(0) = Eigen::Vector3d::UnitX() * edge_model.sigma;
    edge.displacement[0] = sigmas;
    edge.num_photographs = 2;
  }
  EstimateSharedOffset(options, state);
  return state.own_bias.shared_offset_sigmas;
}

// All modes that move an edge, each as large as the samples' bias says, move it by what edges lie
// off in all.
TEST(EstimateSharedOffset, ModesTogetherMoveAnEdgeAsFarAsEdgesLieOff) {
  AlignedSample sample;
  sample.origin_px = {400, 100};
  sample.precision = 1;
  sample.shared_bias_px = SharedOffsetWhereEdgesLieOff(0.8);  // at a pixel for each sigma
  EXPECT_NEAR(WhitenedSystematicModes({&sample, 1}, 600, 400).norm(), 0.8, 1e-9);
}

TEST(EstimateSharedOffset, StaysWithinTheOptions) {
  const JointOptions options;
  EXPECT_NEAR(SharedOffsetWhereEdgesLieOff(5),
              options.most_shared_offset_sigmas / std::sqrt(kNumModesOfAnEdge),
              1e-9);
  EXPECT_NEAR(SharedOffsetWhereEdgesLieOff(0),
              options.least_shared_offset_sigmas / std::sqrt(kNumModesOfAnEdge),
              1e-9);
}

// The house's groups, each moved by so many of the model's sigmas.
struct MovedHouse {
  explicit MovedHouse(double sigmas) {
    state.groups_of_edge = edge_model.groups.of_edge;
    for (auto& parts : state.groups_of_edge) {
      for (EdgeGroupPart& part : parts) part.directions *= edge_model.sigma;
    }
    for (MovingGroup& group : state.groups) group.move.setConstant(sigmas);
  }

  PolygonModel model = MakeHouse();
  EdgeModel edge_model{model};
  std::vector<AlignedPhotograph> photographs;
  std::vector<TiePoint> ties;
  JointOptions options;
  JointState state{edge_model, photographs, {}, ties, options};
};

TEST(EstimateGroupOffset, AGoodModelIsBelievedMoreAndNothingMoves) {
  MovedHouse house(0.25);
  const Eigen::Vector3d before = house.state.GroupMoveOf(0);
  EstimateGroupOffset(house.options, house.state);
  EXPECT_NEAR(house.state.group_offset_sigmas, 0.5, 1e-9);
  EXPECT_NEAR((house.state.GroupMoveOf(0) - before).norm(), 0, 1e-9);
  EXPECT_NEAR(house.state.groups[0].move[0], 0.5, 1e-9);
}

TEST(EstimateGroupOffset, StaysWithinTheOptionsAndWantsEnoughGroups) {
  MovedHouse far(4), exact(0), few(0.25);
  EstimateGroupOffset(far.options, far.state);
  EXPECT_EQ(far.state.group_offset_sigmas, 1);
  EstimateGroupOffset(exact.options, exact.state);
  EXPECT_NEAR(exact.state.group_offset_sigmas, exact.options.least_group_offset_sigmas, 1e-9);
  few.options.least_groups = 1000;
  EstimateGroupOffset(few.options, few.state);
  EXPECT_EQ(few.state.group_offset_sigmas, 1);
}

// What photographs show of a displaced group may be a single edge, or none.
TEST(JointState, ADisplacedGroupStaysThereHoweverLittleIsSeenOfIt) {
  const PolygonModel house = MakeHouse();
  EdgeModel edge_model(house);
  edge_model.group_offsets.assign(edge_model.groups.num_numbers.size(), Eigen::Vector2d::Zero());
  const int edge = 0;
  const EdgeGroupPart& part = edge_model.groups.of_edge[edge].front();
  edge_model.group_offsets[part.group][0] = 0.7;
  const std::vector<AlignedPhotograph> photographs;
  const std::vector<TiePoint> ties;
  const JointState state(edge_model, photographs, {}, ties, {});
  EXPECT_LT((state.GroupMoveOf(edge) - 0.7 * part.directions.col(0)).norm(), 1e-9);
}

}  // namespace
}  // namespace groundglass
