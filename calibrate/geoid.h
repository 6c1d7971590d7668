// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// How far the sea's level lies above the WGS 84 ellipsoid at a place, metres, by a geoid of
// GeographicLib's grids: "egm96-5", "egm2008-1", ... (Karney,
// https://geographiclib.sourceforge.io). Throws Error, with what to do, if the program was built
// without GeographicLib or the grid is not installed.
double SeaLevelAboveEllipsoid_m(const std::string& geoid,
                                double latitude_deg,
                                double longitude_deg);

// Whether the program was built with GeographicLib.
bool HasGeoids();

}  // namespace groundglass
