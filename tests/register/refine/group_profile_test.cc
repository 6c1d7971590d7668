// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/group_profile.h"

#include "tests/register/house.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace groundglass {
namespace {

// The house as it stands: its roof and chimney top are so much higher than the model has them.
PolygonModel HouseWithRaisedRoof(double higher) {
  PolygonModel house = MakeHouse();
  for (Eigen::Vector3d& point : house.points_in_world) {
    if (point.z() >= 16) point.z() += higher;
  }
  return house;
}

// The offset at which a profile says most, and how much more than where the model has the set.
struct Best {
  double offset_sigmas = 0;
  double gain_nats = 0;
};
Best BestOf(const GroupProfile& profile) {
  const auto most = std::max_element(profile.gain_nats.begin(), profile.gain_nats.end());
  return {OffsetSigmas(static_cast<size_t>(most - profile.gain_nats.begin()), {}),
          *most - profile.gain_nats[profile.gain_nats.size() / 2]};
}

// Of the sets that go up and down, the one that would gain most elsewhere.
Best BestOfHouse(double higher) {
  ViewTag tag;
  tag.position_in_site = {62, 48, 5};
  tag.lookat_in_site = {20, -4, 11};
  tag.aspect = 1.5;
  tag.view_angle_deg = 54;
  const PolygonModel model = MakeHouse();
  const EdgeModel edge_model(model);
  const CameraPrior prior =
      MakeCameraPrior(tag, kPhotoWidth, kPhotoHeight, LengthUnit::kFoot, {}, {});
  const EdgeEvidence evidence(
      PhotographModel(HouseWithRaisedRoof(higher), prior.CameraAt(CameraParameters::Zero()), 2, 7),
      {});
  const Solution best = SolveFrom({}, edge_model, evidence, prior, {}, {});
  Best of_all;
  const auto profiles = FindGroupProfiles(best, edge_model, evidence, prior, {}, {});
  EXPECT_FALSE(profiles.empty()) << "no set is asked for";
  for (const GroupProfile& profile : profiles) {
    if (!edge_model.groups.sets[profile.set].across_in_world.isZero()) continue;
    const Best found = BestOf(profile);
    if (found.gain_nats > of_all.gain_nats) of_all = found;
  }
  return of_all;
}

TEST(FindGroupProfiles, SaysMostWhereTheRoofIs) {
  const Best raised = BestOfHouse(0.9);
  EXPECT_NEAR(raised.offset_sigmas, 9, 1);
  EXPECT_GT(raised.gain_nats, 15);
  const Best lowered = BestOfHouse(-0.7);
  EXPECT_NEAR(lowered.offset_sigmas, -7, 1);
}

TEST(FindGroupProfiles, SaysLittleElsewhereOfAModelThatIsRight) {
  const Best right = BestOfHouse(0);
  EXPECT_TRUE(right.gain_nats < 3 || std::abs(right.offset_sigmas) < 1)
      << right.offset_sigmas << " sigmas, " << right.gain_nats << " nats";
}

}  // namespace
}  // namespace groundglass
