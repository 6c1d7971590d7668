// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/osu_io.h"

#include "scene/frames.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A wall seen from the south (+y in `site`), 10 wide and 5 high, and the ground before it.
constexpr const char* kWall =
    "% unit: m\n"
    "% origin: 40.0 -83.0 230\n"
    "% north: 12.5\n"
    "6 2 % points, faces\n"
    "0 0 0   10 0 0\n"
    "10 0 5   0 0 5\n"
    "0 8 0 10 8\n"
    "0\n"
    "4 1 2 3 4 % south wall\n"
    "% face 2: lawn: mown\n"
    "4 1 5\n"
    "6 2\n";

TEST(ParseOsu, ReadsPointsFacesNamesAndComments) {
  const ModelReading reading = ParseOsu(kWall, "model.osu");
  const PolygonModel& model = reading.model;
  ASSERT_EQ(model.points_in_world.size(), 6u);
  EXPECT_EQ(model.points_in_world[4], Eigen::Vector3d(0, -8, 0));
  ASSERT_EQ(model.faces.size(), 2u);
  EXPECT_THAT(model.faces[0].points, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(model.faces[1].points, ElementsAre(0, 4, 5, 1));
  EXPECT_EQ(model.faces[0].name, "south wall");
  EXPECT_EQ(model.faces[1].name, "lawn: mown");
  EXPECT_EQ(model.unit, LengthUnit::kMetre);
  ASSERT_TRUE(model.georeference);
  EXPECT_EQ(model.georeference->longitude_deg, -83);
  EXPECT_EQ(model.georeference->north_deg, 12.5);
  EXPECT_TRUE(reading.warnings.empty());
}

TEST(ParseOsu, CounterclockwiseSeenFromTheFrontPointsOutInWorld) {
  // Seen from the south, east is on the right: 1 2 3 4 runs counterclockwise, so the front looks
  // south, which is -Y in `world`; the lawn's front looks up.
  const PolygonModel model = ParseOsu(kWall, "model.osu").model;
  EXPECT_EQ(ComputeFacePlane(model, 0).normal_in_world, Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(ComputeFacePlane(model, 1).normal_in_world, Eigen::Vector3d(0, 0, 1));
}

TEST(ParseOsu, UnitIsFeetUnlessSaid) {
  EXPECT_EQ(ParseOsu("3 1 0 0 0 1 0 0 0 1 0 3 1 2 3", "m").model.unit, LengthUnit::kFoot);
}

struct BadModel {
  const char* text;
  const char* expected;
};

class BadModelTest : public testing::TestWithParam<BadModel> {};

TEST_P(BadModelTest, GivesItsOneLine) {
  EXPECT_EQ(ThrownMessage([&] { ParseOsu(GetParam().text, "model.osu"); }), GetParam().expected);
}

constexpr const char* kHuge = "1000000000000 5\n0 0 0\n";

INSTANTIATE_TEST_SUITE_P(
    Faults,
    BadModelTest,
    testing::Values(
        BadModel{"", "model.osu:1: the file ends where the number of points is expected"},
        BadModel{"four 1", "model.osu:1: the number of points: 'four' is not a whole number"},
        BadModel{"4.5 1", "model.osu:1: the number of points: '4.5' is not a whole number"},
        BadModel{"2 1 0 0 0 1 1 1", "model.osu:1: a model needs at least 3 points and 1 face"},
        BadModel{kHuge, "model.osu:1: the file is too short for 1000000000000 points and 5 faces"},
        BadModel{"-3 1", "model.osu:1: a model needs at least 3 points and 1 face"},
        BadModel{"3 99999999999999999999 1 2 3 4 5 6 7 8 9 3 1 2 3",
                 "model.osu:1: the file is too short for 3 points and 9223372036854775807 faces"},
        BadModel{"% unit: m\n% unit: ft\n3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3",
                 "model.osu:2: unit 'ft', but a line before says m; leave the right one"},
        BadModel{"3 1\n0 0 0\n1 zero 0\n0 1 0\n3 1 2 3",
                 "model.osu:3: point 2, y: 'zero' is not a number"},
        BadModel{"3 1\n0 0 0\n1 inf 0\n0 1 0\n3 1 2 3",
                 "model.osu:3: point 2, y: 'inf' is not a finite number"},
        BadModel{"3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 4",
                 "model.osu:5: face 1: point number 4 is outside 1 to 3"},
        BadModel{"3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
                 "model.osu:5: face 1: point number 0 is outside 1 to 3"},
        BadModel{"3 1\n0 0 0\n1 0 0\n0 1 0\n2 1 2 % sill",
                 "model.osu:5: face 1 (sill) has 2 points; a face needs at least 3"},
        BadModel{"3 1\n0 0 0\n1 0 0\n0 1 0\n4 1 2 3 2",
                 "model.osu:5: face 1 has point 2 more than once"},
        BadModel{"3 1\n0 0 0\n1 1 1\n2 2 2\n3 1 2 3",
                 "model.osu:5: face 1 has no area: its points lie on a line, or its parts cancel "
                 "out"},
        BadModel{"4 1\n0 0 0\n4 0 0\n0 5 0\n5 3 0\n4 1 2 3 4",
                 "model.osu:6: face 1 crosses or touches itself: its sides 2-3 and 4-1 meet"},
        BadModel{"3 1\n0 0 0\n1 0 0\n0 1 0\n4 1 2 3", "model.osu:5: face 1 cannot have 4 points"},
        BadModel{"3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n7",
                 "model.osu:6: there is more after the last face"},
        BadModel{"% unit: cubit\n3 1 0 0 0 1 0 0 0 1 0 3 1 2 3",
                 "model.osu:1: unit 'cubit' is not known; expected ft, m, mm, cm, in or us-ft"},
        BadModel{"% origin: 40\n3 1 0 0 0 1 0 0 0 1 0 3 1 2 3",
                 "model.osu:1: expected '% origin: LATITUDE LONGITUDE HEIGHT'"}));

TEST(ParseOsu, AUnitInOtherWordsIsTold) {
  const std::string numbers = "3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3";
  for (const char* comment :
       {"% Unit = meters", "% units: m", "% unit m", "% all lengths in metres"}) {
    EXPECT_THAT(ParseOsu(std::string(comment) + "\n" + numbers, "model.osu").warnings,
                ElementsAre(testing::AllOf(testing::HasSubstr("model.osu:1: speaks of a unit"),
                                           testing::HasSubstr("write '% unit: m'"))))
        << comment;
  }
  for (const char* comment :
       {"% unit: m", "% units: ft", "% drawn in 1988", "% door in the m wing", "% in", "%"}) {
    EXPECT_THAT(ParseOsu(std::string(comment) + "\n" + numbers, "model.osu").warnings,
                testing::IsEmpty())
        << comment;
  }
  EXPECT_THAT(ParseOsu(numbers + " % wall in metres", "model.osu").warnings, testing::IsEmpty());
}

TEST(FindOsuFaults, TellsEveryFaultyFace) {
  const std::vector<std::string> faults =
      FindOsuFaults("4 3\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 1 2 9\n3 1 2 3\n3 1 1 2\n", "m.osu");
  EXPECT_THAT(faults,
              ElementsAre("m.osu:6: face 1: point number 9 is outside 1 to 4",
                          "m.osu:8: face 3 has point 1 more than once"));
}

TEST(ParseOsu, DropsRepeatedAndClosingCornersWithANote) {
  const ModelReading reading =
      ParseOsu("4 1\n0 0 0\n1 0 0\n1 0 0\n0 1 0\n5 1 2 3 4 1 % sill", "model.osu");
  EXPECT_THAT(reading.model.faces[0].points, ElementsAre(0, 1, 3));
  EXPECT_THAT(reading.warnings,
              ElementsAre("model.osu: 1 face repeats a corner or closes its ring; the corner is "
                          "dropped: face 1 (sill), line 6"));
}

TEST(ParseOsu, WarnsOfAFaceOutOfPlane) {
  const ModelReading reading =
      ParseOsu("4 1\n0 0 0\n10 0 0\n10 10 0.2\n0 10 0\n4 1 2 3 4 % deck", "m.osu");
  ASSERT_EQ(reading.warnings.size(), 1u);
  // A corner 0.2 off spreads to 0.05 at each; the diagonal is 14.14.
  EXPECT_EQ(reading.warnings[0],
            "m.osu:6: face 1 (deck) is 0.35 % of its size out of plane; its best plane is used");
}

TEST(ParseOsu, TellsFacesOutOfPlaneTogetherWithTheWorst) {
  const ModelReading reading = ParseOsu(
      "8 2\n0 0 0\n10 0 0\n10 10 0.2\n0 10 0\n20 0 0\n30 0 0\n30 10 0.4\n20 10 0\n"
      "4 1 2 3 4 % deck\n4 5 6 7 8 % roof\n",
      "m.osu");
  EXPECT_THAT(reading.warnings,
              ElementsAre("m.osu: 2 faces are out of plane by more than 0.1 % of their size; their "
                          "best planes are used; the worst: face 2 (roof), line 11, 0.71 %"));
}

TEST(ParseOsu, AllowsConcaveFacesAndATenthOfAPermilleOutOfPlane) {
  const ModelReading reading =
      ParseOsu("6 1\n0 0 0\n10 0 0\n10 10 0.002\n5 10 0\n5 5 0\n0 5 0\n6 1 2 3 4 5 6", "m.osu");
  EXPECT_TRUE(reading.warnings.empty());
}

TEST(FormatOsu, ReadsBackToTheLastBit) {
  PolygonModel model = ParseOsu(kWall, "model.osu").model;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> jitter(-1e-5, 1e-5);
  for (Eigen::Vector3d& point : model.points_in_world) {
    for (double& coordinate : point) coordinate += jitter(random);
  }
  const PolygonModel again = ParseOsu(FormatOsu(model), "again.osu").model;
  EXPECT_EQ(again.points_in_world, model.points_in_world);
  ASSERT_EQ(again.faces.size(), model.faces.size());
  for (size_t i = 0; i < model.faces.size(); ++i) {
    EXPECT_EQ(again.faces[i].points, model.faces[i].points);
    EXPECT_EQ(again.faces[i].name, model.faces[i].name);
  }
  EXPECT_EQ(again.unit, model.unit);
  ASSERT_TRUE(again.georeference);
  EXPECT_EQ(again.georeference->north_deg, 12.5);
}

TEST(ReadOsu, ReadsTheBrickScene) {
  const ModelReading reading =
      ReadOsu(std::string(GROUNDGLASS_SOURCE_DIR) + "/datasets-synthetic/brick/model.osu");
  EXPECT_EQ(reading.model.points_in_world.size(), 108u);
  EXPECT_EQ(reading.model.faces.size(), 70u);
  EXPECT_EQ(reading.model.faces[7].name, "hall west gable");
  EXPECT_TRUE(reading.warnings.empty());
}

}  // namespace
}  // namespace groundglass
