// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/photograph_place.h"

#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A wall 10 m wide and 5 m high whose left foot is the origin, at 48 N 2 E, 100 m high.
PolygonModel MakeWall(double north_deg) {
  PolygonModel model;
  model.unit = LengthUnit::kMetre;
  model.points_in_world = {{0, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}};
  model.faces.push_back({});
  model.georeference = Georeference{48, 2, 100, north_deg};
  return model;
}

// So many metres north and east of the origin, where a degree of latitude is 111.2 km.
GpsFix FixAt(double north_m, double east_m, double height_m) {
  GpsFix fix;
  fix.latitude_deg = 48 + north_m / 111200;
  fix.longitude_deg = 2 + east_m / (111600 * std::cos(48 * M_PI / 180));
  fix.height_m = height_m;
  return fix;
}

double ValueOf(const KnownKeys& keys, const std::string& name) {
  for (const KnownKey& key : keys) {
    if (key.key == name) return *ParseNumber(key.value);
  }
  ADD_FAILURE() << "no key " << name;
  return NAN;
}

TEST(PhotographPlace, APhoneThatLooksNorthIsSouthOfWhatItSees) {
  PhotographMetadata metadata;
  metadata.gps = FixAt(-20, 5, 102);
  metadata.gps->horizontal_sigma_m = 4;
  metadata.direction.bearing_deg = 0;
  metadata.direction.pitch_deg = 10;
  metadata.direction.roll_deg = -1;
  const PhotographPlace place = FindPhotographPlace(metadata, MakeWall(0));
  EXPECT_THAT(place.faults, IsEmpty());
  // In `site` y counts south.
  EXPECT_NEAR(ValueOf(place.keys, "x"), 5, 0.05);
  EXPECT_NEAR(ValueOf(place.keys, "y"), 20, 0.05);
  EXPECT_NEAR(ValueOf(place.keys, "z"), 2, 0.01);
  EXPECT_NEAR(ValueOf(place.keys, "i"), 5, 0.05);
  EXPECT_LT(ValueOf(place.keys, "j"), 1);
  EXPECT_GT(ValueOf(place.keys, "k"), 4);
  EXPECT_EQ(ValueOf(place.keys, "roll"), -1);
  EXPECT_EQ(ValueOf(place.keys, "sigma_position"), 4);
  EXPECT_EQ(ValueOf(place.keys, "sigma_height"), 10);
  // With a and v it is a tag.
  EXPECT_THAT(FindViewFaults(WithKeys("a 1.5 v 50", place.keys), "p"), IsEmpty());
}

TEST(PhotographPlace, TheModelsNorthTurnsPlaceAndDirection) {
  // The site's north points east: what lies east of the origin lies north in `site`, at a y below
  // 0.
  PhotographMetadata metadata;
  metadata.gps = FixAt(0, 20, 102);
  metadata.direction.bearing_deg = 270;  // looks west, which is `site`'s south
  const PhotographPlace place = FindPhotographPlace(metadata, MakeWall(90));
  EXPECT_NEAR(ValueOf(place.keys, "x"), 0, 0.05);
  EXPECT_NEAR(ValueOf(place.keys, "y"), -20, 0.05);
  EXPECT_GT(ValueOf(place.keys, "j"), -5);
  EXPECT_NEAR(ValueOf(place.keys, "i"), 0, 0.05);
  // The pitch is not known: taken for level, and far from sure.
  EXPECT_NEAR(ValueOf(place.keys, "k"), ValueOf(place.keys, "z"), 1e-9);
  EXPECT_GT(ValueOf(place.keys, "sigma_lookat"), 4);
}

TEST(PhotographPlace, MagneticBearingsAreWideUntilTheDeclinationIsGiven) {
  PhotographMetadata metadata;
  metadata.gps = FixAt(-20, 5, 102);
  metadata.direction.bearing_deg = 350;
  metadata.direction.is_bearing_magnetic = true;
  metadata.direction.pitch_deg = 0;
  PlaceOptions options;
  options.declination_deg = 10;
  const PhotographPlace given = FindPhotographPlace(metadata, MakeWall(0), options);
  EXPECT_NEAR(ValueOf(given.keys, "i"), ValueOf(given.keys, "x"), 1e-6);
  const PhotographPlace open = FindPhotographPlace(metadata, MakeWall(0));
  EXPECT_GT(ValueOf(open.keys, "sigma_lookat"), 1.4 * ValueOf(given.keys, "sigma_lookat"));
}

TEST(PhotographPlace, UsualMistakesAreNamed) {
  const auto faults_of = [](const GpsFix& fix) {
    PhotographMetadata metadata;
    metadata.gps = fix;
    const PhotographPlace place = FindPhotographPlace(metadata, MakeWall(0));
    EXPECT_THAT(place.keys, IsEmpty());
    return place.faults;
  };
  GpsFix west = FixAt(-20, 5, 102);
  west.longitude_deg *= -1;
  EXPECT_THAT(faults_of(west),
              ElementsAre(HasSubstr("with east and west exchanged it would be 21 m")));
  GpsFix exchanged = FixAt(-20, 5, 102);
  std::swap(exchanged.latitude_deg, exchanged.longitude_deg);
  EXPECT_THAT(faults_of(exchanged),
              ElementsAre(HasSubstr("with latitude and longitude exchanged")));
  EXPECT_THAT(faults_of(FixAt(-20, 5, 335)), ElementsAre(HasSubstr("it seems to be in feet")));
  GpsFix flat = FixAt(-20, 5, 102);
  flat.height_m.reset();
  EXPECT_THAT(faults_of(flat), ElementsAre("GPS position without a height"));
}

TEST(PhotographPlace, AModelThatStandsNowhereTakesNoPosition) {
  PhotographMetadata metadata;
  metadata.gps = FixAt(-20, 5, 102);
  PolygonModel model = MakeWall(0);
  model.georeference.reset();
  const PhotographPlace place = FindPhotographPlace(metadata, model);
  EXPECT_THAT(place.keys, IsEmpty());
  EXPECT_THAT(place.faults, ElementsAre(HasSubstr("% origin")));
}

}  // namespace
}  // namespace groundglass
