// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/refine_photograph.h"

#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace groundglass {
namespace {

// The house from the south-east, its lean-to built so much higher than it is drawn; its photograph
// hardly has noise.
struct HouseAndPhotograph {
  PolygonModel model = MakeHouse();
  EdgeModel edge_model{model};
  ViewTag true_tag;
  Camera truth;
  EdgeEvidence evidence{Image8(kPhotoWidth, kPhotoHeight, 1), {}};

  explicit HouseAndPhotograph(double shed_is_higher_ft = 0) {
    true_tag.position_in_site = {62, 48, 5};
    true_tag.lookat_in_site = {20, -4, 11};
    true_tag.aspect = 1.5;
    true_tag.view_angle_deg = 54;
    truth = CameraFromTag(true_tag, kPhotoWidth, kPhotoHeight);
    PolygonModel built = model;
    for (Eigen::Vector3d& point : built.points_in_world) {
      if (point.z() == 8) point.z() += shed_is_higher_ft;
    }
    evidence = EdgeEvidence(PhotographModel(built, truth, 0.5, 1), {});
  }

  std::vector<bool> EdgesOfShed() const {
    std::vector<bool> of_shed;
    for (const ModelEdge& edge : edge_model.edges) {
      of_shed.push_back(edge.start_in_world.z() <= 8 && edge.end_in_world.z() <= 8 &&
                        std::min(edge.start_in_world.y(), edge.end_in_world.y()) < 0);
    }
    return of_shed;
  }

  // A tag that sees the house this far to the right of where it is, and as far below.
  CameraPrior PriorOff(double px) const {
    ViewTag measured = true_tag;
    measured.shift_x += px / std::sqrt(2) / kPhotoWidth;
    measured.shift_y += px / std::sqrt(2) / kPhotoWidth;
    return MakeCameraPrior(measured, kPhotoWidth, kPhotoHeight, model.unit, {}, {});
  }
};

TEST(RefinePhotograph, EndsAtTheTruthFromAStartSomePixelsOff) {
  const HouseAndPhotograph house;
  for (const double off_px : {3.0, 8.0}) {
    const CameraPrior prior = house.PriorOff(off_px);
    const CameraParameters start = CameraParameters::Zero();
    EXPECT_NEAR(VertexErrorPx(house.model, house.truth, prior.CameraAt(start)), off_px, 0.2);
    const Refinement refined = RefinePhotograph(start, house.edge_model, house.evidence, prior, {});
    EXPECT_EQ(refined.outcome, Refinement::Outcome::kConverged) << off_px;
    EXPECT_LT(VertexErrorPx(house.model, house.truth, prior.CameraAt(refined.whitened)), 0.1)
        << off_px;
    const std::optional<ResidualSpread> spread = SpreadOf(refined.residuals);
    ASSERT_TRUE(spread);
    EXPECT_LT(spread->robust_sigma_px, 0.2) << off_px;
    // It has learnt something, and says so.
    EXPECT_LT(refined.covariance.trace(), 0.8 * kNumCameraParameters);
  }
}

TEST(RefinePhotograph, AStartOffAllEdgesDoesNotConverge) {
  const PolygonModel model = MakeHouse();
  // The house from afar, on the left; it is looked for in the empty sky, 200 px to its right.
  ViewTag tag;
  tag.position_in_site = {188, 204, 15};
  tag.lookat_in_site = {20, -4, 11};
  tag.aspect = 1.5;
  tag.view_angle_deg = 54;
  tag.shift_x = -1.0 / 6;
  const EdgeEvidence evidence(
      PhotographModel(model, CameraFromTag(tag, kPhotoWidth, kPhotoHeight), 0, 1), {});
  tag.shift_x = 1.0 / 6;
  const CameraPrior prior = MakeCameraPrior(tag, kPhotoWidth, kPhotoHeight, model.unit, {}, {});
  const Refinement refined =
      RefinePhotograph(CameraParameters::Zero(), EdgeModel(model), evidence, prior, {});
  EXPECT_GT(refined.samples.size(), 30u);
  EXPECT_EQ(refined.outcome, Refinement::Outcome::kTooFewEdges);
  EXPECT_EQ(refined.whitened, CameraParameters::Zero());
}

TEST(RefinePhotograph, APhotographWithoutEdgesLeavesTheStartAndThePrior) {
  const HouseAndPhotograph house;
  const EdgeEvidence blank(Image8(kPhotoWidth, kPhotoHeight, 1, 128), {});
  const CameraPrior prior = house.PriorOff(0);
  const CameraParameters start = 0.1 * CameraParameters::Ones();
  const Refinement refined = RefinePhotograph(start, house.edge_model, blank, prior, {});
  EXPECT_EQ(refined.outcome, Refinement::Outcome::kTooFewEdges);
  EXPECT_EQ(refined.whitened, start);
  EXPECT_EQ(refined.covariance, CameraCovariance::Identity());
  EXPECT_TRUE(refined.residuals.empty());
}

TEST(RefinePhotograph, FewerMatchesThanAreAskedForAreTooFew) {
  const HouseAndPhotograph house;
  RefineOptions options;
  options.min_matched = 100000;
  const Refinement refined = RefinePhotograph(
      CameraParameters::Zero(), house.edge_model, house.evidence, house.PriorOff(0), options);
  EXPECT_EQ(refined.outcome, Refinement::Outcome::kTooFewEdges);
}

TEST(RefineWithoutEdges, WithoutAnyTheStartAndThePriorAreLeft) {
  const HouseAndPhotograph house;
  const CameraPrior prior = house.PriorOff(3);
  for (const double start : {0.0, 0.1}) {
    const Refinement refined =
        RefineWithoutEdges(start * CameraParameters::Ones(),
                           house.edge_model,
                           std::vector<bool>(house.edge_model.edges.size(), true),
                           house.evidence,
                           prior,
                           {});
    EXPECT_EQ(refined.outcome, Refinement::Outcome::kTooFewEdges);
    EXPECT_EQ(refined.whitened, start * CameraParameters::Ones());
    EXPECT_EQ(refined.covariance, CameraCovariance::Identity());
    EXPECT_TRUE(refined.samples.empty());
    EXPECT_EQ(refined.num_matched, 0);
  }
}

TEST(RefineWithoutEdges, WithAllOfThemIsAsRefinePhotograph) {
  const HouseAndPhotograph house;
  const CameraPrior prior = house.PriorOff(3);
  const CameraParameters start = CameraParameters::Zero();
  const Refinement refined =
      RefineWithoutEdges(start,
                         house.edge_model,
                         std::vector<bool>(house.edge_model.edges.size(), false),
                         house.evidence,
                         prior,
                         {});
  const Refinement expected = RefinePhotograph(start, house.edge_model, house.evidence, prior, {});
  EXPECT_EQ(refined.whitened, expected.whitened);
  EXPECT_EQ(refined.covariance, expected.covariance);
}

TEST(RefineWithoutEdges, WhatIsLeftOutPullsNoCamera) {
  const HouseAndPhotograph house(0.2);
  const CameraPrior prior = house.PriorOff(3);
  const std::vector<bool> of_shed = house.EdgesOfShed();
  const CameraParameters start = CameraParameters::Zero();
  const auto error_px = [&](const Refinement& refined) {
    return VertexErrorPx(house.model, house.truth, prior.CameraAt(refined.whitened));
  };
  const Refinement with = RefinePhotograph(start, house.edge_model, house.evidence, prior, {});
  const Refinement without =
      RefineWithoutEdges(start, house.edge_model, of_shed, house.evidence, prior, {});
  const auto is_of_shed = [&](const EdgeSample& sample) { return of_shed[sample.edge]; };
  EXPECT_TRUE(std::any_of(with.samples.begin(), with.samples.end(), is_of_shed));
  EXPECT_TRUE(std::none_of(without.samples.begin(), without.samples.end(), is_of_shed));
  EXPECT_EQ(without.outcome, Refinement::Outcome::kConverged);
  EXPECT_LT(error_px(without), 0.1);
  EXPECT_GT(error_px(with), 0.3);
}

TEST(RefineWithoutEdges, LockedParametersStayAsTheTagHasThem) {
  const HouseAndPhotograph house;
  ViewTag measured = house.true_tag;
  measured.position_in_site.x() += 0.4;
  measured.view_angle_deg += 0.5;
  PriorOptions options;
  options.lock = {"x", "v"};
  const CameraPrior prior =
      MakeCameraPrior(measured, kPhotoWidth, kPhotoHeight, house.model.unit, {}, options);
  const Refinement refined = RefineWithoutEdges(
      CameraParameters::Zero(), house.edge_model, house.EdgesOfShed(), house.evidence, prior, {});
  EXPECT_EQ(refined.outcome, Refinement::Outcome::kConverged);
  const CameraParameters change = prior.ParametersAt(refined.whitened) - prior.mean;
  EXPECT_EQ(change[kPositionX], 0);
  EXPECT_EQ(change[kViewAngle], 0);
  EXPECT_GT(std::abs(change[kYaw]), 0.01) << "what is free makes up for it";
}

}  // namespace
}  // namespace groundglass
