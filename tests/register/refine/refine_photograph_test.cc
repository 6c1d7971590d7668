// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/refine_photograph.h"

#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace groundglass {
namespace {

// The house from the south-east; its photograph hardly has noise.
struct HouseAndPhotograph {
  PolygonModel model = MakeHouse();
  EdgeModel edge_model{model};
  ViewTag true_tag;
  Camera truth;
  EdgeEvidence evidence{Image8(kPhotoWidth, kPhotoHeight, 1), {}};

  HouseAndPhotograph() {
    true_tag.position_in_site = {62, 48, 5};
    true_tag.lookat_in_site = {20, -4, 11};
    true_tag.aspect = 1.5;
    true_tag.view_angle_deg = 54;
    truth = CameraFromTag(true_tag, kPhotoWidth, kPhotoHeight);
    evidence = EdgeEvidence(PhotographModel(model, truth, 0.5, 1), {});
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

}  // namespace
}  // namespace groundglass
