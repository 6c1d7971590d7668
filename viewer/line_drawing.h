// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <array>
#include <string>

namespace groundglass {

using Srgb8Colour = std::array<uint8_t, 3>;

// How much of each pixel a drawing covers, 0 to 1; one channel. Lines are added to it, then it is
// laid over a picture in one colour, so that crossings do not come out denser than the lines.
using CoverageMask = ImageF;

// Adds an antialiased line with round ends: each pixel's share is found from its centre's distance
// to the line, so that widths and positions hold to a fraction of a pixel. Both ends in `image`.
void AddLine(CoverageMask& coverage,
             const Eigen::Vector2d& start_px,
             const Eigen::Vector2d& end_px,
             double width_px);

// Lays one colour over an sRGB picture of 3 channels, or of 4 with alpha not premultiplied, where
// covered.
void LayOver(Image8& srgb8, const CoverageMask& coverage, Srgb8Colour colour, double opacity);

// Antialiased text whose baseline starts at `baseline_px` (image); capitals are cap_height_px high.
void DrawText(Image8& srgb8,
              const std::string& text,
              const Eigen::Vector2d& baseline_px,
              double cap_height_px,
              Srgb8Colour colour);
// The width that DrawText takes, px.
double TextWidth(const std::string& text, double cap_height_px);

}  // namespace groundglass
