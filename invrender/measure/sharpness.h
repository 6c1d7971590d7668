// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/detail_options.h"
#include "invrender/measure/patch.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

struct Sharpness {
  // Variance of the blur along x and y, px^2: lens, focus, shake, and the pixels themselves.
  Eigen::Vector2d blur_px2 = Eigen::Vector2d::Zero();
  // What to multiply the photograph's resolution by: 1 where it is as sharp as most, less where it
  // was shaken or out of focus.
  double factor = 1;
};

// Compares what photographs show of the same patches. Blur obeys the heat equation: the difference
// of two pictures of one thing is half of the difference of their blurs' variances, times the
// second derivatives of their mean. All pairs are solved together by least squares. Brightness,
// contrast and part of a pixel's shift are fitted apart, and patches that do not look alike are
// left out. Photographs that share too little with others count as ordinary. One for each
// photograph.
std::vector<Sharpness> MeasureSharpness(const std::vector<Patch>& patches,
                                        size_t num_photos,
                                        const SharpnessOptions& options);

}  // namespace groundglass
