// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Tags and cameras that all mean something else than they say: heights, angles, units.
#include "scene/advice/advice.h"
#include "scene/formats/scene.h"
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

TEST(MisreadTags, DegreesOfLongitudeAndLatitudeAreToldAlone) {
  Scene scene = ReadHall();
  scene.model_file = "hall/model.obj";
  for (Eigen::Vector3d& point : scene.model.points_in_world) {
    point = {11.5 + 4e-6 * point.x(), 48.1 + 2.7e-6 * point.y(), 500 + 0.3048 * point.z()};
  }
  EXPECT_THAT(ToldOf(scene),
              ElementsAre(testing::AllOf(HasSubstr("hall/model.obj: its x and y are degrees"),
                                         HasSubstr("x from 11."),
                                         HasSubstr("QGIS"))));
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

// The only advice of the scene with its pictures.
std::string OnlyAdviceOf(const Scene& scene) {
  const std::vector<Advice> found = FindOddities(scene);
  return found.size() == 1 ? FormatAdvice(found[0])
                           : std::to_string(found.size()) + " pieces of advice";
}

TEST(MisreadTags, GivenCamerasThatNoPictureSuitsAreTold) {
  const std::filesystem::path brick = kBrick;
  SceneOptions options;
  options.views = brick / "truth/cameras";
  Scene scene = ReadScene(brick, options);
  // The building turned about its middle: the cameras see it, from elsewhere.
  const Eigen::Vector3d middle = ComputeBounds(scene.model).Center();
  for (Eigen::Vector3d& point : scene.model.points_in_world) {
    point.head<2>() = 2 * middle.head<2>() - point.head<2>();
  }
  const std::vector<Advice> found = FindModelOddities(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(FormatAdvice(found[0]), HasSubstr("no more than by chance"));
}

TEST(MisreadTags, ABuildingTurnedWhereItStandsIsTold) {
  Scene scene = ReadHall();
  const Eigen::Vector3d middle = ComputeBounds(scene.model).Center();
  for (Eigen::Vector3d& point : scene.model.points_in_world) {
    point.head<2>() = 2 * middle.head<2>() - point.head<2>();
  }
  EXPECT_THAT(OnlyAdviceOf(scene), HasSubstr("turned by 180 degrees about its middle"));
}

TEST(MisreadTags, ABuildingOfAnotherSizeIsToldAndNoTagBlamed) {
  Scene scene = ReadHall();
  for (Eigen::Vector3d& point : scene.model.points_in_world) point *= 1.12;
  EXPECT_THAT(OnlyAdviceOf(scene), HasSubstr("no more than by chance"));
}

TEST(MisreadTags, TagsBesideTheNextPhotographAreTold) {
  Scene scene = ReadHall();
  const ViewTag first = scene.photographs.front().tag;
  for (size_t i = 0; i + 1 < scene.photographs.size(); ++i) {
    scene.photographs[i].tag = scene.photographs[i + 1].tag;
  }
  scene.photographs.back().tag = first;
  EXPECT_THAT(OnlyAdviceOf(scene), HasSubstr("stands beside the photograph before its own"));
}

TEST(MisreadTags, TwoTagsThatAreExchangedAreTold) {
  Scene scene = ReadHall();
  std::swap(scene.photographs[1].tag, scene.photographs[6].tag);
  EXPECT_THAT(OnlyAdviceOf(scene),
              HasSubstr("the tags of " + scene.photographs[1].name + " and " +
                        scene.photographs[6].name + " are exchanged"));
}

TEST(MisreadTags, HeightsThatWereNotWrittenAreTold) {
  Scene scene = ReadHall();
  for (Photograph& photograph : scene.photographs) photograph.tag.lookat_in_site.z() = 0;
  EXPECT_THAT(ToldOf(scene), ElementsAre(HasSubstr("k is 0 in every tag")));
}

TEST(MisreadTags, DirectionsInPlaceOfPointsAreTold) {
  Scene scene = ReadHall();
  for (Photograph& photograph : scene.photographs) {
    ViewTag& tag = photograph.tag;
    tag.lookat_in_site = (tag.lookat_in_site - tag.position_in_site).normalized();
  }
  EXPECT_THAT(ToldOf(scene), ElementsAre(HasSubstr("i, j, k are a direction in every tag")));
}

TEST(MisreadTags, AModelWhoseHeightsCountDownwardsIsTold) {
  Scene scene = ReadHall();
  for (Eigen::Vector3d& point : scene.model.points_in_world) point.z() *= -1;
  EXPECT_THAT(OnlyAdviceOf(scene), HasSubstr("its z counts downwards"));
}

// The tags of a table with yaw and pitch, which the reader made look-at points of.
TEST(MisreadTags, AnglesOfATableThatCountOtherwiseAreTold) {
  Scene scene = ReadHall();
  scene.tags_have_angles = true;
  for (Photograph& photograph : scene.photographs) {
    ViewTag& tag = photograph.tag;
    tag.lookat_in_site.z() = 2 * tag.position_in_site.z() - tag.lookat_in_site.z();
  }
  EXPECT_THAT(OnlyAdviceOf(scene), HasSubstr("pitch counts downwards in the table"));
}

}  // namespace
}  // namespace groundglass
