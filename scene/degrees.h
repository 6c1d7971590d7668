// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"

#include <string>

namespace groundglass {

// True if x and y of a model with these bounds can only be degrees of longitude and latitude, in
// either order, beneath heights that are lengths: it lies on the globe by its numbers and would be
// a needle, hundreds of times as high as it is wide, of less than two hundredths of its unit.
bool SeemInDegrees(const Box& bounds);

// For a person: from where to where it runs, as "x from 11.5 to 11.50014, y from 48.1 to 48.10007,
// 8 high".
std::string DescribeDegrees(const Box& bounds);

// What is to be done with such a model.
constexpr const char* kProjectIt =
    "project it to a system that counts in metres (UTM or the country's own), for example with "
    "QGIS (Export, Save Features As, CRS) or with the program that made it";

}  // namespace groundglass
