// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "ask/place.h"

#include <vector>

namespace groundglass {

// A length or an area with one standard deviation, and what that is made of; to first order.
struct Measure {
  double value = 0;  // model's unit, or its square
  double sigma = 0;
  double camera_sigma = 0;
  double pixel_sigma = 0;
  double model_sigma = 0;
};

// What two places have in common (a camera, a face's plane) does not spoil what lies between them
// twice: a common shift of both cancels.
Measure MeasureDistance(const Place& from, const Place& to);
// Of the triangle of three places.
Measure MeasureArea(const Place& a, const Place& b, const Place& c);

}  // namespace groundglass
