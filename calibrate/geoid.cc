// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/geoid.h"

#include "scene/error.h"

#ifdef GROUNDGLASS_HAS_GEOGRAPHICLIB
#include <GeographicLib/Geoid.hpp>
#endif

namespace groundglass {

#ifdef GROUNDGLASS_HAS_GEOGRAPHICLIB

bool HasGeoids() { return true; }

double SeaLevelAboveEllipsoid_m(const std::string& geoid,
                                double latitude_deg,
                                double longitude_deg) {
  try {
    return GeographicLib::Geoid(geoid)(latitude_deg, longitude_deg);
  } catch (const GeographicLib::GeographicErr&) {
    throw Error("geoid " + geoid + " is not among GeographicLib's grids in " +
                GeographicLib::Geoid::DefaultGeoidPath() +
                "; install it with `geographiclib-get-geoids " + geoid +
                "` (Debian: geographiclib-tools), or give the sea's level in metres, --geoid 44.6");
  }
}

#else

bool HasGeoids() { return false; }

double SeaLevelAboveEllipsoid_m(const std::string& geoid, double, double) {
  throw Error("geoid " + geoid +
              ": this program was built without GeographicLib (Debian: libgeographiclib-dev); give "
              "the sea's level above the ellipsoid in metres, --geoid 44.6");
}

#endif

}  // namespace groundglass
