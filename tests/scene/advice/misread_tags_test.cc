// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Tags and cameras that all mean something else than they say: heights, angles, units.
#include "scene/advice/advice.h"
#include "scene/formats/scene_folder.h"
#include "tests/support/brick_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Scene ReadHall() {
  static const Scene scene = ReadScene(kBrick);
  return scene;
}

// Without a look at the pictures.
std::vector<std::string> ToldOf(const Scene& scene) {
  std::vector<std::string> lines;
  for (const Advice& advice : FindOddities(scene, {}, false)) {
    lines.push_back(FormatAdvice(advice));
  }
  return lines;
}

TEST(MisreadTags, HeightsThatCountDownwardsAreTold) {
  Scene scene = ReadHall();
  for (Photograph& photograph : scene.photographs) {
    photograph.tag.position_in_site.z() *= -1;
    photograph.tag.lookat_in_site.z() *= -1;
  }
  const std::vector<Advice> found = FindOddities(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(FormatAdvice(found[0]), HasSubstr("z counts downwards in the tags"));
}

TEST(MisreadTags, LookAtPointsOfAnotherZeroAreTold) {
  Scene scene = ReadHall();
  for (Photograph& photograph : scene.photographs) photograph.tag.lookat_in_site.z() += 60;
  const std::vector<Advice> found = FindOddities(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(FormatAdvice(found[0]), HasSubstr("too high in all tags"));
}

TEST(MisreadTags, PlacesAndLookAtPointsThatAreExchangedAreTold) {
  Scene scene = ReadHall();
  for (Photograph& photograph : scene.photographs) {
    std::swap(photograph.tag.position_in_site, photograph.tag.lookat_in_site);
  }
  const std::vector<Advice> found = FindOddities(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(FormatAdvice(found[0]), HasSubstr("are exchanged"));
}

TEST(MisreadTags, AnglesInRadiansAndHalfAnglesAreTold) {
  Scene scene = ReadHall();
  for (Photograph& photograph : scene.photographs) {
    photograph.tag.view_angle_deg *= M_PI / 180;
  }
  EXPECT_THAT(ToldOf(scene), ElementsAre(HasSubstr("an angle in radians, it seems")));
  for (Photograph& photograph : scene.photographs) {
    photograph.tag.view_angle_deg *= 180 / M_PI / 2;
  }
  const std::vector<Advice> found = FindOddities(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(FormatAdvice(found[0]), HasSubstr("v is half the view angle"));
}

TEST(MisreadTags, AspectsThatAreHeightOverWidthAreToldOnce) {
  Scene scene = ReadHall();
  for (Photograph& photograph : scene.photographs)
    photograph.tag.aspect = 1 / photograph.tag.aspect;
  EXPECT_THAT(ToldOf(scene), ElementsAre(HasSubstr("a is height / width in every tag")));
}

// Their tags are made from them, and look at the model's middle.
TEST(MisreadTags, GivenCamerasOfAnotherUnitAreTold) {
  const std::filesystem::path brick = kBrick;
  SceneOptions options;
  options.views = brick / "truth/cameras";
  Scene scene = ReadScene(brick, options);
  EXPECT_THAT(FindModelOddities(scene), IsEmpty());
  for (Eigen::Vector3d& point : scene.model.points_in_world) point *= 0.3048;
  const std::vector<Advice> found = FindModelOddities(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(FormatAdvice(found[0]), HasSubstr("3.28 times as large"));
}

TEST(MisreadTags, ALensWrittenInPlaceOfTheViewAngleIsTold) {
  Scene scene = ReadHall();
  for (Photograph& photograph : scene.photographs) {
    double& angle_deg = photograph.tag.view_angle_deg;
    angle_deg = 18 / std::tan(angle_deg * M_PI / 360);
  }
  const std::vector<Advice> found = FindOddities(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(FormatAdvice(found[0]), HasSubstr("v is the lens's focal length in mm"));
}

}  // namespace
}  // namespace groundglass
