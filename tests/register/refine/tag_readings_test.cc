// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/tag_readings.h"

#include "register/register.h"
#include "tests/register/house.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ViewTag FarTag() {
  ViewTag tag;
  tag.position_in_site = {60, 70, 6};
  tag.lookat_in_site = {20, 0, 10};
  tag.aspect = 1.5;
  return tag;
}

// A search that proposes the true camera wherever the prior holds it, and the tag's own; refinement
// that stays where it starts; and a score that falls with the distance from the true camera.
struct ReadingFixture {
  PolygonModel model = MakeHouse();
  EdgeModel edge_model{model};
  Image8 blank = Image8(kSmallWidth, kSmallHeight, 1);
  EdgeEvidence evidence{blank, {}};
  SolutionOptions solutions;
  ReadingOptions options;
  CameraParameters truth = ParametersFromTag(FarTag());
  double most_nats_per_observation = 1;

  ReadingFixture() {
    solutions.stages.find_hypotheses =
        [this](const auto&, const CameraPrior& prior, const auto&, const HypothesisOptions& own) {
          std::vector<Hypothesis> starts;
          const CameraParameters whitened = prior.WhitenedAt(truth);
          if (whitened.norm() < own.reach_sigmas * 2) starts.push_back({whitened, 50});
          starts.push_back({CameraParameters::Zero(), 0});
          return starts;
        };
    solutions.stages.refine = [this](const CameraParameters& start,
                                     const EdgeModel&,
                                     const EdgeEvidence&,
                                     const CameraPrior& prior,
                                     const RefineOptions&,
                                     const std::vector<ControlPoint>&) {
      Refinement refinement;
      refinement.whitened = start;
      refinement.samples = SampleVisibleEdges(edge_model, prior.CameraAt(start), 0, 10);
      return refinement;
    };
    solutions.stages.score =
        [this](const auto&, const ParameterProjection& projection, const auto&, const auto&) {
          const ParameterProjection meant =
              PriorOf(FarTag()).ProjectionAt(CameraParameters::Zero());
          double off = 0;
          for (const Eigen::Vector3d& point : model.points_in_world) {
            const auto seen_px = projection.ImageOf(point);
            off += seen_px ? (*seen_px - *meant.ImageOf(point)).norm() : 1000;
          }
          off /= static_cast<double>(model.points_in_world.size());
          return AlignmentScore{.nats = 100 * most_nats_per_observation - 10 * off,
                                .observations = 100};
        };
  }

  CameraPrior PriorOf(const ViewTag& tag) const {
    return MakeCameraPrior(tag, kSmallWidth, kSmallHeight, LengthUnit::kFoot, {}, {});
  }

  std::vector<TagReading> Read(const ViewTag& written,
                               const std::vector<NamedTag>& others = {}) const {
    return ReadTag(
        edge_model,
        evidence,
        PriorOf(written),
        [this](const ViewTag& tag) { return PriorOf(tag); },
        others,
        {},
        solutions,
        options);
  }
};

TEST(ReadTag, OneThatFitsIsReadAsItIsWrittenOnly) {
  const std::vector<TagReading> readings = ReadingFixture().Read(FarTag());
  ASSERT_EQ(readings.size(), 1u);
  EXPECT_EQ(readings[0].slip, "");
  EXPECT_EQ(readings[0].widening, 1);
}

TEST(ReadTag, OneThatIsFarOffIsReadWithLargerErrors) {
  const ReadingFixture fixture;
  ViewTag written = FarTag();
  // With the look-at point, so that the direction stays.
  const double off = 8 * fixture.PriorOf(written).sigmas[kPositionX];
  written.position_in_site.x() += off;
  written.lookat_in_site.x() += off;
  const std::vector<TagReading> readings = fixture.Read(written);
  ASSERT_FALSE(readings.empty());
  EXPECT_EQ(readings[0].slip, "");
  EXPECT_EQ(readings[0].widening, fixture.options.wider_factor);
  const CameraParameters found =
      readings[0].prior.ParametersAt(readings[0].solutions.front().refinement.whitened);
  EXPECT_NEAR(found[kPositionX], fixture.truth[kPositionX], 1e-6);
  ReadingFixture never;
  never.options.wider_factor = 1;
  never.options.num_slips = 0;
  for (const TagReading& reading : never.Read(written)) EXPECT_EQ(reading.widening, 1);
}

// A camera that the tag allows is the tag's own, even where only the wider search has found it.
TEST(ReadTag, WhatTheTagAllowsIsNotTakenForALargerError) {
  ReadingFixture fixture;
  fixture.most_nats_per_observation = 0.4;  // doubtful, however right
  const std::vector<TagReading> readings = fixture.Read(FarTag());
  ASSERT_FALSE(readings.empty());
  EXPECT_EQ(readings[0].widening, 1);
  EXPECT_GT(readings[0].solutions.size(), 2u);
}

TEST(ReadTag, ASlipOfThePenIsNamed) {
  ViewTag written = FarTag();
  written.position_in_site.y() *= -1;
  const std::vector<TagReading> readings = ReadingFixture().Read(written);
  ASSERT_FALSE(readings.empty());
  EXPECT_EQ(readings[0].slip, "the sign of y changed (it counts south)");
  ReadingFixture none;
  none.options.num_slips = 0;
  for (const TagReading& reading : none.Read(written)) EXPECT_EQ(reading.slip, "");
}

TEST(ReadTag, AnotherPhotographsNumbersAreNamed) {
  ViewTag written = FarTag();
  written.position_in_site = {-80, 35, 5};
  const std::vector<TagReading> readings = ReadingFixture().Read(written, {{"s7", FarTag()}});
  ASSERT_FALSE(readings.empty());
  EXPECT_EQ(readings[0].slip, "the numbers of s7");
}

TEST(FindRival, IsTheBestElsewhereInAnyReading) {
  const ReadingFixture fixture;
  const CameraPrior prior = fixture.PriorOf(FarTag());
  const auto solution = [&](double x, double nats) {
    Solution made;
    made.refinement.whitened[0] = x;
    made.refinement.samples =
        SampleVisibleEdges(fixture.edge_model, prior.CameraAt(CameraParameters::Zero()), 0, 10);
    made.score.nats = nats;
    return made;
  };
  std::vector<TagReading> readings = {{"", 1, prior, 0, {solution(0, 100), solution(3, 40)}},
                                      {"a slip", 1, prior, -10, {solution(-3, 60)}}};
  const Rival rival = FindRival(readings, fixture.solutions);
  EXPECT_EQ(rival.solution, &readings[1].solutions[0]);
  EXPECT_EQ(rival.reading, &readings[1]);
  EXPECT_NEAR(rival.total_score, 60 - 10 - 4.5, 1e-9);
  // Less probable, it is none.
  readings[1].log_probability = -30;
  EXPECT_EQ(FindRival(readings, fixture.solutions).solution, &readings[0].solutions[1]);
  readings[0].solutions.pop_back();
  readings.pop_back();
  EXPECT_EQ(FindRival(readings, fixture.solutions).solution, nullptr);
}

// From the photograph to the verdict: a house from the south-east, and tags that are wrong.
struct HouseFromTheSouthEast {
  PolygonModel model = MakeHouse();
  ViewTag truth;
  Camera camera;
  Image8 photograph;

  HouseFromTheSouthEast() : truth(FarTag()) {
    truth.position_in_site = {62, 48, 5};
    truth.lookat_in_site = {20, -4, 11};
    camera = CameraFromTag(truth, 600, 400);
    photograph = PhotographModel(model, camera, 2, 5);
  }

  Registration Register(const ViewTag& written) const {
    return RegisterPhotograph({"test", photograph, {}, written, {}}, EdgeModel(model), {});
  }
};

TEST(RegisterPhotograph, ATagThatErrsMoreThanItClaimsIsFoundAndTold) {
  const HouseFromTheSouthEast house;
  ViewTag written = house.truth;
  written.sigmas.position = 0.5;
  written.position_in_site.y() -= 8;
  const Registration found = house.Register(written);
  EXPECT_LT(VertexErrorPx(house.model, house.camera, found.CorrectedCamera()), 1);
  EXPECT_EQ(found.verdict, Verdict::kReview);
  EXPECT_THAT(found.reasons,
              ElementsAre(testing::AllOf(HasSubstr("other than written: "),
                                         HasSubstr("ft further south"),
                                         HasSubstr("times what the tag's sigmas claim"))));
}

TEST(RegisterPhotograph, ABlunderIsNamedAndPutRight) {
  const HouseFromTheSouthEast house;
  ViewTag written = house.truth;
  written.position_in_site.y() *= -1;
  const Registration found = house.Register(written);
  EXPECT_LT(VertexErrorPx(house.model, house.camera, found.CorrectedCamera()), 1);
  EXPECT_EQ(found.verdict, Verdict::kReview);
  EXPECT_THAT(found.reasons, ElementsAre(HasSubstr("but with the sign of y changed")));
}

}  // namespace
}  // namespace groundglass
