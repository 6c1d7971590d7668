// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/split_prior.h"

#include <gtest/gtest.h>

namespace groundglass {
namespace {

CameraPrior PriorOfATag() {
  ViewTag tag;
  tag.position_in_site = {30, 60, 5};
  tag.lookat_in_site = {20, 0, 10};
  PriorOptions options;
  options.lock = {"shift_y"};
  return MakeCameraPrior(tag, 600, 400, LengthUnit::kFoot, {}, options);
}

TEST(SplitIntoOwnAndLens, ThePartsTogetherHaveTheWholesCovariance) {
  const CameraPrior prior = PriorOfATag();
  const SplitPrior split = SplitIntoOwnAndLens(prior, LensParameters{{0.7, 0.2, 1, 1, 0.001}});
  const CameraCovariance covariance =
      split.own_root * split.own_root.transpose() + split.lens_root * split.lens_root.transpose();
  EXPECT_TRUE(covariance.isApprox(prior.root * prior.root.transpose(), 1e-12));
}

TEST(SplitIntoOwnAndLens, ALensPartHoldsItsShareOfTheVariance) {
  const CameraPrior prior = PriorOfATag();
  const SplitPrior split = SplitIntoOwnAndLens(prior, LensParameters{{0.7, 0.2, 1, 1, 0.001}});
  const double variance = prior.sigmas[kK1] * prior.sigmas[kK1];
  EXPECT_NEAR(split.lens_root.row(kK1).squaredNorm(), 0.999 * variance, 1e-12);
  EXPECT_NEAR(split.own_root.row(kK1).squaredNorm(), 0.001 * variance, 1e-12);
  EXPECT_EQ(split.lens_root.row(kYaw).squaredNorm(), 0);
}

TEST(SplitIntoOwnAndLens, ItsMapGivesTheWholesWhitenedParametersBack) {
  const CameraPrior prior = PriorOfATag();
  const SplitPrior split = SplitIntoOwnAndLens(prior, LensParameters{{0.7, 0.2, 0.3, 0.3, 0.5}});
  const CameraParameters own = CameraParameters::LinSpaced(-1, 2);
  const LensParameters lens{{0.3, -0.4, 0.7, 0, 1.2}};
  Eigen::Matrix<double, kNumCameraParameters + kNumLensParameters, 1> parts;
  parts << own, lens;
  const CameraParameters change = split.own_root * own + split.lens_root * lens;
  EXPECT_LT((prior.root * (split.whole_from_parts * parts) - change).norm(), 1e-9);
}

}  // namespace
}  // namespace groundglass
