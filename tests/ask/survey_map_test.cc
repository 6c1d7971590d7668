// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "ask/survey_map.h"

#include "scene/formats/image_io.h"
#include "tests/ask/room_survey.h"
#include "tests/support/spoilt_options.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace groundglass {
namespace {

const std::atomic<bool> kGoOn = false;

Eigen::Vector3d MiddleOf(const FaceCells& face, int column, int row) {
  return face.corner_in_world + (column + 0.5) * face.across_in_world +
         (row + 0.5) * face.up_in_world;
}

TEST(SurveyMap, SaysOfEachCellWhatWhereSaysOfItsMiddle) {
  const Survey survey = MakeWallSurvey();
  const Visibility visibility(survey.model);
  SurveyMapOptions options;
  options.num_cells = 120;
  const auto map = MapSurvey(survey, visibility, kGoOn, options);
  ASSERT_TRUE(map);
  ASSERT_EQ(map->size(), survey.model.faces.size());
  const FaceCells& wall = (*map)[0];
  int num_shown_somewhere = 0;
  for (int row = 0; row < wall.rows; ++row) {
    for (int column = 0; column < wall.columns; ++column) {
      const MapCell& cell = wall.At(column, row);
      const Eigen::Vector3d middle = MiddleOf(wall, column, row);
      int num_shown = 0;
      double least = 1e300;
      const auto sightings = FindSightings(survey, visibility, PlaceOnModel(survey, middle, 0));
      for (const Sighting& sighting : sightings) {
        if (sighting.state != SightingState::kShown) continue;
        ++num_shown;
        const Place place =
            PlaceInPhotograph(survey, visibility, sighting.photograph, *sighting.image_px, 0);
        least = std::min(least, place.Covariance().trace());
      }
      EXPECT_EQ(cell.num_photographs, num_shown);
      if (num_shown == 0) continue;
      ++num_shown_somewhere;
      EXPECT_NEAR(cell.sigma, std::sqrt(least), 1e-9);
      EXPECT_NEAR(cell.pixel_size, sightings[0].pixel_size[0], 1e-9);
      EXPECT_EQ(&wall.AtPoint(middle), &cell);
    }
  }
  EXPECT_GT(num_shown_somewhere, 20);
}

TEST(SurveyMap, AFaceThatNoCellsMiddleIsInIsAskedAllTheSame) {
  Survey survey = MakeWallSurvey();
  // A strip up the wall and along its foot, whose middle lies beside it.
  survey.model.points_in_world.insert(survey.model.points_in_world.begin() + 4,
                                      {{20, 0, 1}, {-19, 0, 1}, {-19, 0, 20}, {-20, 0, 20}});
  survey.model.faces = {{{0, 1, 4, 5, 6, 7}, "strip", 1}};
  const Visibility visibility(survey.model);
  SurveyMapOptions options;
  options.num_cells = 1;
  const auto map = MapSurvey(survey, visibility, kGoOn, options);
  ASSERT_TRUE(map);
  const std::vector<MapCell>& cells = (*map)[0].cells;
  EXPECT_TRUE(std::all_of(cells.begin(), cells.end(), [](const MapCell& cell) {
    return cell.num_photographs > 0 && cell.finest;
  }));
}

TEST(SurveyMap, IsGivenUpWhenAsked) {
  const Survey survey = MakeWallSurvey();
  const std::atomic<bool> stop = true;
  EXPECT_FALSE(MapSurvey(survey, Visibility(survey.model), stop));
}

TEST(TexelSources, AreTheBakedPhotographsInNaturalOrderAndFitThePages) {
  const TemporaryFolder folder;
  TexturedModel textured;
  textured.pages.push_back({Image8(4, 2, 3), {}});
  EXPECT_FALSE(ReadTexelSources(folder.path(), textured));
  for (const char* name : {"s10", "s2"}) {
    WriteLabels(folder / ("faces/" + std::string(name) + ".png"), Image16(2, 2, 1));
  }
  Image16 numbers(4, 2, 1, 2);
  numbers.values[0] = kProvenanceFilled;
  WriteLabels(folder / "provenance_0.png", numbers);
  const auto sources = ReadTexelSources(folder.path(), textured);
  ASSERT_TRUE(sources);
  EXPECT_EQ(sources->photographs, (std::vector<std::string>{"s2", "s10"}));
  EXPECT_EQ(sources->pages[0].values, numbers.values);
  // A number that nobody has is another run's.
  numbers.values[1] = 3;
  WriteLabels(folder / "provenance_0.png", numbers);
  EXPECT_FALSE(ReadTexelSources(folder.path(), textured));
}

TEST(SurveyMapOptions, AreChecked) {
  ExpectCheckNamesEach<SurveyMapOptions>(
      {{"num_cells", [](SurveyMapOptions& o) { o.num_cells = 0; }},
       {"min_angle_deg", [](SurveyMapOptions& o) { o.sighting.min_angle_deg = -1; }}});
}

}  // namespace
}  // namespace groundglass
