// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/geoid.h"

#include "scene/formats/tags_csv.h"
#include "scene/frames.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#ifdef GROUNDGLASS_HAS_GEOGRAPHICLIB
#include <GeographicLib/LocalCartesian.hpp>
#endif

namespace groundglass {
namespace {

using testing::HasSubstr;

// A grid as GeographicLib keeps them, of 4 x 3 places, 44.6 m everywhere.
std::string EvenGrid() {
  std::string grid =
      "P5\n# Description An even sea\n# DateTime 2000-01-01 00:00:00\n# MaxBilinearError 0\n"
      "# RMSBilinearError 0\n# MaxCubicError 0\n# RMSCubicError 0\n# Offset 0\n# Scale 0.01\n"
      "# Origin 90N 0E\n# AREA_OR_POINT Point\n4 3\n65535\n";
  for (int i = 0; i < 12; ++i)
    grid += {static_cast<char>(4460 / 256), static_cast<char>(4460 % 256)};
  return grid;
}

TEST(Geoid, TheSeasLevelIsReadFromAGridAndAMissingOneSaysWhatToDo) {
  const TemporaryFolder folder;
  folder.Write("even.pgm", EvenGrid());
  ASSERT_EQ(setenv("GEOGRAPHICLIB_GEOID_PATH", folder.path().c_str(), 1), 0);
  const std::string message = ThrownMessage([] { SeaLevelAboveEllipsoid_m("none", 48, 2); });
  if (!HasGeoids()) {
    EXPECT_THAT(message, HasSubstr("built without GeographicLib"));
    return;
  }
  EXPECT_NEAR(SeaLevelAboveEllipsoid_m("even", 48.1, 2.3), 44.6, 1e-6);
  EXPECT_THAT(message, HasSubstr("install it with `geographiclib-get-geoids none`"));
}

#ifdef GROUNDGLASS_HAS_GEOGRAPHICLIB
TEST(Geoid, OurLocalFrameIsGeographicLibs) {
  PolygonModel model;
  model.unit = LengthUnit::kMetre;
  model.georeference = Georeference{48.8, 2.3, 60, 0};
  const GeographicLib::LocalCartesian frame(48.8, 2.3, 60);
  for (const auto& [latitude, longitude, height] : {std::array{48.8, 2.3, 60.0},
                                                    {48.81, 2.28, 75.0},
                                                    {48.3, 3.1, -20.0},
                                                    {51.0, -1.0, 400.0}}) {
    Eigen::Vector3d theirs;
    frame.Forward(latitude, longitude, height, theirs.x(), theirs.y(), theirs.z());
    const Eigen::Vector3d ours =
        WorldFromSite(SiteFromGeodetic(model, latitude, longitude, height));
    EXPECT_LT((ours - theirs).norm(), 1e-8) << latitude;  // metres
  }
}
#endif

}  // namespace
}  // namespace groundglass
