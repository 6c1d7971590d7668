// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/best_elsewhere.h"

#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <utility>

namespace groundglass {
namespace {

// A photograph of the house. Its cameras here differ by how far they shift the picture to one side.
class BestElsewhereTest : public testing::Test {
 protected:
  BestElsewhereTest() {
    ViewTag tag;
    tag.position_in_site = {8, 62, 5};
    tag.lookat_in_site = {20, -8, 9};
    tag.aspect = 1.5;
    tag.view_angle_deg = 54;
    photograph_.prior = MakeCameraPrior(tag, kPhotoWidth, kPhotoHeight, LengthUnit::kFoot, {}, {});
  }

  CameraParameters ShiftedBy(double px) const {
    CameraParameters parameters = photograph_.prior.mean;
    parameters[kShiftX] += px / kPhotoWidth;
    return photograph_.prior.WhitenedAt(parameters);
  }
  // The photograph came with the camera at 0 px, for which 100 nats speak, and its second-best one
  // is at 10 px with 80.
  BestElsewhere WithCommonSolutionAt(double px, double nats) {
    photograph_.whitened = ShiftedBy(px);
    photograph_.second_best_whitened = ShiftedBy(10);
    photograph_.second_best_nats = 80;
    return FindBestElsewhere(
        photograph_, nats, {ShiftedBy(0), 100}, MakeHouse().points_in_world, 4);
  }

  AlignedPhotograph photograph_;
};

// Two px here are four at a width of 1200.
TEST_F(BestElsewhereTest, IsTheSecondBestWhereTheCommonSolutionKeepsThePlace) {
  const BestElsewhere found = WithCommonSolutionAt(1.5, 70);
  ASSERT_TRUE(found.camera);
  EXPECT_LT((*found.camera - ShiftedBy(10)).norm(), 1e-9);
  EXPECT_NEAR(found.distance_px, 8.5, 0.1);
  EXPECT_NEAR(found.lead_nats, 70 - 80, 1e-9);
}

TEST_F(BestElsewhereTest, IsThePhotographsOwnWhereTheCommonSolutionHasLeftIt) {
  const BestElsewhere found = WithCommonSolutionAt(9, 60);
  ASSERT_TRUE(found.camera);
  EXPECT_LT((*found.camera - ShiftedBy(0)).norm(), 1e-9);
  EXPECT_NEAR(found.distance_px, 9, 0.1);
  EXPECT_NEAR(found.lead_nats, 60 - 100, 1e-9);
}

TEST_F(BestElsewhereTest, IsTheBetterOneWhereBothAreElsewhere) {
  const BestElsewhere found = WithCommonSolutionAt(5, 60);
  ASSERT_TRUE(found.camera);
  EXPECT_LT((*found.camera - ShiftedBy(0)).norm(), 1e-9);
  EXPECT_NEAR(found.lead_nats, 60 - 100, 1e-9);
}

TEST_F(BestElsewhereTest, IsNoneWhereThePhotographHadOneCameraAlone) {
  photograph_.whitened = ShiftedBy(1);
  EXPECT_FALSE(
      FindBestElsewhere(photograph_, 90, {ShiftedBy(0), 100}, MakeHouse().points_in_world, 4)
          .camera);
}

TEST(ShareOfElsewhere, IsHalfWhereEdgesSayAsMuchAndNoneWhereTheLeadIsEnough) {
  EXPECT_DOUBLE_EQ(ShareOfElsewhere(0, 20), 0.5);
  EXPECT_DOUBLE_EQ(ShareOfElsewhere(10, 20), 0.25);
  EXPECT_DOUBLE_EQ(ShareOfElsewhere(20, 20), 0);
  EXPECT_DOUBLE_EQ(ShareOfElsewhere(-20, 20), 1);
  EXPECT_DOUBLE_EQ(ShareOfElsewhere(-90, 20), 1);
}

// Evidence of 100 observations, and so of a least margin of 20 nats.
Evidence EvidenceWithMargin(double margin_nats) {
  Evidence evidence;
  evidence.score = {150, 100};
  evidence.margin_nats = margin_nats;
  return evidence;
}

TEST(CoverBoth, ACameraThatIsNearWidensTheClaimTowardsIt) {
  const CameraParameters elsewhere = 2 * CameraParameters::Unit(1);
  Evidence evidence = EvidenceWithMargin(0);
  CameraCovariance covariance = CameraCovariance::Identity();
  CoverBoth(CameraParameters::Zero(), elsewhere, 1.5, {}, evidence, covariance);
  EXPECT_TRUE(evidence.claim_covers_both);
  EXPECT_NEAR(covariance(1, 1), 1 + 0.5 * 4, 1e-12);
  EXPECT_NEAR(covariance.trace(), kNumCameraParameters + 0.5 * 4, 1e-12);
}

TEST(CoverBoth, OneThatIsFarOrBeatenIsNotCovered) {
  const CameraParameters elsewhere = CameraParameters::Unit(1);
  for (const auto& [margin_nats, distance_px] : {std::pair(0.0, 2.5), std::pair(20.0, 1.5)}) {
    Evidence evidence = EvidenceWithMargin(margin_nats);
    CameraCovariance covariance = CameraCovariance::Identity();
    CoverBoth(CameraParameters::Zero(), elsewhere, distance_px, {}, evidence, covariance);
    EXPECT_FALSE(evidence.claim_covers_both);
    EXPECT_TRUE(covariance.isIdentity());
  }
}

}  // namespace
}  // namespace groundglass
