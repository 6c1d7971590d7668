// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to exchange.
#pragma once

#include <string_view>
#include <vector>

namespace groundglass {

// The numbers in EPSG's register that a system of coordinates is named by, in any of the ways of
// GML, its parts one after the other if it is put together of several: "EPSG:25832",
// "urn:ogc:def:crs,crs:EPSG::4258,crs:EPSG::5621", "http://www.opengis.net/def/crs/EPSG/0/6697".
std::vector<int> EpsgCodes(std::string_view coordinate_system);

// True if any part of the system counts in degrees of longitude and latitude.
bool IsGeographic(std::string_view coordinate_system);

}  // namespace groundglass
