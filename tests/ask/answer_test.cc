// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/answer.h"

#include "scene/error.h"
#include "tests/ask/room_survey.h"
#include "tests/support/spoilt_options.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace groundglass {
namespace {

using testing::HasSubstr;

Answer AskThree(const Survey& survey) {
  const Visibility visibility(survey.model);
  return AnswerPlaces(survey,
                      visibility,
                      {PlaceInPhotograph(survey, visibility, 0, {150, 200}, 0),
                       PlaceOnModel(survey, {20, 0, 0}, 1),
                       PlaceOnModel(survey, {-20, 0, 20}, 2)});
}

TEST(Answer, JsonHasPlacesInSiteAndAllThatIsMeasured) {
  const Survey survey = MakeWallSurvey();
  const Answer answer = AskThree(survey);
  const auto json = nlohmann::json::parse(FormatAnswerJson(survey, answer));
  ASSERT_EQ(json["places"].size(), 3u);
  EXPECT_EQ(json["unit"], "ft");
  EXPECT_EQ(json["places"][2]["point"], nlohmann::json({-20.0, -0.0, 20.0}));
  EXPECT_EQ(json["places"][0]["pointed_at"]["photograph"], "front");
  EXPECT_EQ(json["places"][0]["faces"][0]["name"], "wall");
  EXPECT_EQ(json["places"][0]["photographs"].size(), 5u);
  EXPECT_DOUBLE_EQ(json["distance"]["value"].get<double>(), answer.distance->value);
  EXPECT_DOUBLE_EQ(json["area"]["sigma"].get<double>(), answer.area->sigma);
  EXPECT_EQ(json["left_out"][0]["photograph"], "lost");
  // The mirror from `world` turns the sign of what y has in common with the others.
  const Eigen::Matrix3d covariance = answer.places[0].Covariance();
  EXPECT_DOUBLE_EQ(json["places"][0]["covariance"][0][1].get<double>(), -covariance(0, 1));
  EXPECT_DOUBLE_EQ(json["places"][0]["covariance"][0][2].get<double>(), covariance(0, 2));
}

TEST(Answer, CsvHasARowForEachPlaceAndPhotographAllOfOneWidth) {
  const Survey survey = MakeWallSurvey();
  const std::string csv = FormatAnswerCsv(survey, AskThree(survey));
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    // What is in quotes may hold a comma of its own.
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), line.find('"') == line.npos ? 18 : 19)
        << line;
  }
  EXPECT_THAT(csv, HasSubstr("\"behind the camera, or beyond what its lens shows\""));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 5);
}

TEST(Answer, AFolderThatIsNeitherSceneNorOutputSaysWhatIsMissing) {
  const TemporaryFolder folder;
  EXPECT_THAT(ThrownMessage([&] { ReadSurvey(folder.path(), {}); }), HasSubstr("no model"));
  EXPECT_THAT(ThrownMessage([&] { ReadSurvey(folder / "gone", {}); }),
              HasSubstr("expected an output folder or a scene"));
}

TEST(Answer, OptionsAreChecked) {
  ExpectCheckNamesEach<PickOptions>(
      {{"pointing_sigma_px", [](PickOptions& o) { o.pointing_sigma_px = 0; }},
       {"on_face_share", [](PickOptions& o) { o.on_face_share = -1; }}});
  ExpectCheckNamesEach<SightingOptions>(
      {{"min_angle_deg", [](SightingOptions& o) { o.min_angle_deg = kNotANumber; }}});
}

}  // namespace
}  // namespace groundglass
