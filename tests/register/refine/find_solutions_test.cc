// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/find_solutions.h"

#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <optional>

namespace groundglass {
namespace {

// The stages replaced by functions that answer at once, so that only their order is tested.
struct SearchFixture {
  PolygonModel model = MakeHouse();
  EdgeModel edge_model{model};
  Image8 blank = Image8(kSmallWidth, kSmallHeight, 1);
  EdgeEvidence evidence{blank, {}};
  CameraPrior prior;
  SolutionOptions options;
  int num_searches = 0;
  int num_refinements = 0;

  SearchFixture() {
    ViewTag tag;
    tag.position_in_site = {60, 70, 6};
    tag.lookat_in_site = {20, 0, 10};
    prior = MakeCameraPrior(tag, kSmallWidth, kSmallHeight, LengthUnit::kFoot, {}, {});
    options.stages.find_hypotheses = [this](const auto&, const auto&, const auto&, const auto&) {
      ++num_searches;
      std::vector<Hypothesis> starts(3);
      for (int i = 0; i < 3; ++i) starts[i].whitened[0] = i - 1;
      return starts;
    };
    options.stages.refine = [this](const CameraParameters& start,
                                   const EdgeModel&,
                                   const EdgeEvidence&,
                                   const CameraPrior&,
                                   const RefineOptions&,
                                   const std::vector<ControlPoint>&) {
      ++num_refinements;
      Refinement refinement;
      refinement.whitened = start;
      refinement.samples = SampleVisibleEdges(edge_model, prior.CameraAt(start), 0, 10);
      return refinement;
    };
    // The camera at +1 is the right one.
    options.stages.score =
        [this](const auto&, const ParameterProjection& projection, const auto&, const auto&) {
          CameraParameters right = CameraParameters::Zero();
          right[0] = 1;
          const Eigen::Vector3d point(20, 0, 10);
          const double off = (projection.Project(point)->image_px -
                              prior.ProjectionAt(right).Project(point)->image_px)
                                 .norm();
          return AlignmentScore{.nats = 100 - off, .observations = 100};
        };
  }

  std::vector<Solution> Find() const {
    return FindSolutions(edge_model, evidence, prior, {}, options);
  }
};

TEST(FindSolutions, RefinesEveryStartAndGivesTheBestFirst) {
  SearchFixture fixture;
  const std::vector<Solution> solutions = fixture.Find();
  ASSERT_EQ(solutions.size(), 3u);
  EXPECT_EQ(fixture.num_searches, 1);
  EXPECT_EQ(solutions[0].refinement.whitened[0], 1);
  EXPECT_GE(solutions[0].TotalScore(), solutions[1].TotalScore());
  EXPECT_GE(solutions[1].TotalScore(), solutions[2].TotalScore());
}

TEST(FindSolutions, WithoutASearchTheTagAloneIsRefined) {
  SearchFixture fixture;
  fixture.options.hypotheses.max_starts = 0;
  EXPECT_EQ(fixture.Find().size(), 1u);
  EXPECT_EQ(fixture.num_searches, 0);
}

TEST(FindSolutions, ATagThatSeesNothingOfTheModelHasNone) {
  SearchFixture fixture;
  fixture.options.min_samples = 100000;
  EXPECT_TRUE(fixture.Find().empty());
  EXPECT_EQ(fixture.num_refinements, 0);
}

TEST(FindSolutions, WhereThePriorBendsItSearchesAgainUntilAScoreIsGood) {
  SearchFixture fixture;
  fixture.prior.root *= 20;  // so wide that edges' paths bend
  fixture.options.hypotheses.max_rounds = 3;
  fixture.options.hypotheses.num_centres = 2;
  fixture.options.hypotheses.again_below_nats_per_observation = 10;  // none is good
  fixture.Find();
  EXPECT_GT(fixture.num_searches, 1);
  fixture.num_searches = 0;
  fixture.options.hypotheses.again_below_nats_per_observation = -1000;  // the first is
  fixture.Find();
  EXPECT_EQ(fixture.num_searches, 1);
}

SecondBest FindElsewhere(const std::vector<Solution>& solutions, const SearchFixture& fixture) {
  return FindSecondBest(
      solutions.front(), fixture.prior, solutions, fixture.prior, fixture.options);
}

TEST(FindSecondBest, IsTheBestThatLiesElsewhere) {
  SearchFixture fixture;
  const std::vector<Solution> solutions = fixture.Find();
  fixture.options.distinct_distance_px = 0;
  const SecondBest near = FindElsewhere(solutions, fixture);
  EXPECT_EQ(near.solution, &solutions[1]);
  EXPECT_GT(near.distance_px, 0);
  // Beyond the second but not the third, at a width of 1200.
  fixture.options.distinct_distance_px = near.distance_px * 1200 / kSmallWidth;
  EXPECT_EQ(FindElsewhere(solutions, fixture).solution, &solutions[2]);
  fixture.options.distinct_distance_px = 1e6;
  EXPECT_EQ(FindElsewhere(solutions, fixture).solution, nullptr);
}

}  // namespace
}  // namespace groundglass
