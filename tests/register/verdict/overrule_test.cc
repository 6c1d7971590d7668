// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/verdict/overrule.h"

#include "register/register.h"
#include "scene/formats/select_photographs.h"
#include "tests/register/house.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

ViewTag SouthEast() {
  ViewTag tag;
  tag.position_in_site = {62, 48, 5};
  tag.lookat_in_site = {20, -4, 11};
  tag.aspect = 1.5;
  tag.view_angle_deg = 54;
  return tag;
}

Registration RegisterHouse(const ViewTag& measured, const OverruleOptions& overrule) {
  const PolygonModel model = MakeHouse();
  const Image8 photograph = PhotographModel(model, CameraFromTag(SouthEast(), 450, 300), 2, 1);
  RegisterOptions options;
  options.overrule = overrule;
  return RegisterPhotograph({"s7", photograph, {}, measured, {}}, EdgeModel(model), options);
}

Scene SceneOf(const std::vector<std::string>& names) {
  Scene scene;
  for (const std::string& name : names) scene.photographs.emplace_back().name = name;
  return scene;
}

TEST(Overrule, PutsThePersonBeforeTheReasons) {
  Registration registration;
  registration.name = "s7";
  registration.verdict = Verdict::kReview;
  registration.reasons = {"another camera fits almost as well"};
  OverruleVerdict({{"s7"}, {}}, registration);
  EXPECT_EQ(registration.verdict, Verdict::kAccepted);
  EXPECT_THAT(registration.reasons,
              ElementsAre("accepted by a person, overruling the verdict review",
                          "another camera fits almost as well"));
}

TEST(Overrule, LeavesOthersAndAgreementAlone) {
  Registration registration;
  registration.name = "s7";
  registration.verdict = Verdict::kAccepted;
  OverruleVerdict({{"s7", "s8"}, {"s9"}}, registration);
  EXPECT_EQ(registration.verdict, Verdict::kAccepted);
  EXPECT_TRUE(registration.reasons.empty());
}

TEST(Overrule, OnePhotographCannotBeBoth) {
  const OverruleOptions both{{"s1", "s2"}, {"s2"}};
  EXPECT_EQ(ThrownMessage([&] { both.Check(); }),
            "options accept and reject: photograph 's2' is in both");
}

TEST(Overrule, ARejectedPhotographKeepsItsMeasuredTag) {
  const Registration found = RegisterHouse(SouthEast(), {});
  ASSERT_EQ(found.verdict, Verdict::kAccepted);
  const Registration rejected = RegisterHouse(SouthEast(), {{}, {"s7"}});
  EXPECT_EQ(rejected.verdict, Verdict::kRejected);
  EXPECT_EQ(rejected.corrected, rejected.measured);
  EXPECT_THAT(rejected.reasons, ElementsAre(StartsWith("rejected by a person")));
}

// A tag 9 ft off with the sigmas of a tape: beyond belief, whatever the edges say.
TEST(Overrule, AnAcceptedPhotographGetsTheCameraThatWasFound) {
  ViewTag wrong = SouthEast();
  wrong.lookat_in_site += Eigen::Vector3d(5, 0, -7);
  const Registration found = RegisterHouse(wrong, {});
  ASSERT_NE(found.verdict, Verdict::kAccepted);
  const Registration accepted = RegisterHouse(wrong, {{"s7"}, {}});
  EXPECT_EQ(accepted.verdict, Verdict::kAccepted);
  EXPECT_NE(accepted.corrected, accepted.measured);
  EXPECT_EQ(accepted.reasons.size(), found.reasons.size() + 1);
  if (found.verdict == Verdict::kReview) {
    EXPECT_EQ(accepted.corrected, found.corrected);
  }
}

TEST(SelectPhotographs, UnknownNamesAreAnErrorThatListsTheNames) {
  EXPECT_EQ(ThrownMessage([] {
              RequirePhotographs(SceneOf({"s1", "s2", "s10"}), {"s2", "s7"}, "option --accept");
            }),
            "option --accept: no photograph is called 's7'; there are s1, s2, s10");
}

TEST(SelectPhotographs, KeepsTheScenesOrder) {
  Scene scene = SceneOf({"s1", "s2", "s10"});
  KeepPhotographs({}, scene);
  EXPECT_EQ(scene.photographs.size(), 3u);
  KeepPhotographs({"s10", "s1"}, scene);
  ASSERT_EQ(scene.photographs.size(), 2u);
  EXPECT_EQ(scene.photographs[0].name, "s1");
  EXPECT_EQ(scene.photographs[1].name, "s10");
}

}  // namespace
}  // namespace groundglass
