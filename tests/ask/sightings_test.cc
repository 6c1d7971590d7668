// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/sightings.h"

#include "tests/ask/room_survey.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace groundglass {
namespace {

using testing::HasSubstr;

std::map<std::string, Sighting> SightingsOf(const Survey& survey,
                                            const Eigen::Vector3d& point_in_world) {
  const Visibility visibility(survey.model);
  std::map<std::string, Sighting> by_name;
  for (const Sighting& sighting :
       FindSightings(survey, visibility, PlaceOnModel(survey, point_in_world, 0))) {
    by_name[survey.photographs[sighting.photograph].name] = sighting;
  }
  return by_name;
}

TEST(Sightings, EachPhotographSaysWhyItDoesNotShowAPlace) {
  const Survey survey = MakeWallSurvey();
  const auto of_low_middle = SightingsOf(survey, {0, 0, 1});
  EXPECT_EQ(of_low_middle.at("front").state, SightingState::kHidden);
  EXPECT_THAT(of_low_middle.at("front").reason, HasSubstr("hidden by face 2 (box south)"));
  EXPECT_EQ(of_low_middle.at("side").state, SightingState::kShown);
  EXPECT_EQ(of_low_middle.at("back").state, SightingState::kBackFace);
  EXPECT_EQ(of_low_middle.at("away").state, SightingState::kBehind);
  EXPECT_EQ(of_low_middle.at("flat").state, SightingState::kGrazing);
  EXPECT_THAT(of_low_middle.at("flat").reason, HasSubstr("2.0 degrees"));
  const auto of_high = SightingsOf(survey, {0, 0, 19});
  EXPECT_EQ(of_high.at("front").state, SightingState::kOutside);
}

TEST(Sightings, APixelsSizeOnTheFaceFollowsFromDistanceAndSlant) {
  const Survey survey = MakeWallSurvey();
  const auto sightings = SightingsOf(survey, {0, 0, 5});
  const double focal_px = 300 / std::tan(RadiansFromDegrees(30));
  const Sighting& front = sightings.at("front");
  EXPECT_NEAR(front.distance, 30, 1e-12);
  EXPECT_NEAR(front.angle_deg, 90, 1e-6);
  EXPECT_NEAR(front.pixel_size[0], 30 / focal_px, 1e-9);
  EXPECT_NEAR(front.pixel_size[1], 30 / focal_px, 1e-9);
  // At 45 degrees, square pixels of 1 are 1.414 long on the wall.
  const Sighting& side = sightings.at("side");
  EXPECT_NEAR(side.angle_deg, 45, 1e-6);
  EXPECT_NEAR(side.pixel_size[0], std::sqrt(2) * std::sqrt(800) / focal_px, 1e-9);
  EXPECT_NEAR(side.pixel_size[1], std::sqrt(800) / focal_px, 1e-9);
}

TEST(Sightings, TheFinestComesFirstAndThoseThatDoNotShowItLast) {
  const Survey survey = MakeWallSurvey();
  const Visibility visibility(survey.model);
  const std::vector<Sighting> sightings =
      FindSightings(survey, visibility, PlaceOnModel(survey, {0, 0, 6}, 0));
  ASSERT_EQ(sightings.size(), 5u);
  EXPECT_EQ(survey.photographs[sightings[0].photograph].name, "front");
  EXPECT_EQ(survey.photographs[sightings[1].photograph].name, "side");
  EXPECT_NE(sightings[2].state, SightingState::kShown);
}

TEST(Sightings, ACornerIsSeenByWhoeverSeesOneOfItsFaces) {
  const Survey survey = MakeWallSurvey();
  const auto sightings = SightingsOf(survey, {2, -10, 4});
  EXPECT_EQ(sightings.at("front").state, SightingState::kShown);
  EXPECT_EQ(sightings.at("side").state, SightingState::kShown);
}

TEST(Sightings, ATexelsSizeFollowsFromWhereTheFaceLiesOnThePage) {
  Survey survey = MakeWallSurvey();
  EXPECT_FALSE(TexelSize(survey, kWallFace));
  survey.textures.resize(survey.model.faces.size());
  // 40 x 20 units on 400 x 100 texels, turned upside down.
  survey.textures[kWallFace] = {0, {{410, 10}, {10, 10}, {10, 110}, {410, 110}}};
  const auto size = TexelSize(survey, kWallFace);
  ASSERT_TRUE(size);
  EXPECT_NEAR((*size)[0], 0.2, 1e-9);
  EXPECT_NEAR((*size)[1], 0.1, 1e-9);
  EXPECT_FALSE(TexelSize(survey, 1));
}

TEST(Sightings, ACropShowsThePlaceInItsMiddle) {
  Image8 picture(100, 80, 3, 10);
  for (int c = 0; c < 3; ++c) picture.At(30, 20)[c] = 200;
  const Image8 crop = CropAround(picture, {30.5, 20.5}, 8, 64);
  ASSERT_EQ(crop.width, 64);
  EXPECT_EQ(crop.At(32, 32)[0], 200);
  const Image8 at_border = CropAround(picture, {0.5, 0.5}, 8, 64);
  EXPECT_EQ(at_border.At(0, 0)[0], 128) << "beyond the picture is grey";
}

}  // namespace
}  // namespace groundglass
