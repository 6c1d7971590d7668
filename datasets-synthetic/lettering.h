// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/material.h"

#include <string>

namespace groundglass {

// Pictures for walls, in linear colour with alpha (4 channels).

// One line of capitals, transparent around them.
ImageF MakeLettering(const std::string& text, const Rgb& color);
// An exhibition's poster: opaque, each number its own.
ImageF MakePoster(int number);
// A mural of coloured bars, opaque where painted.
ImageF MakeBars();
// Stones at a wall's corner, long and short in turn, for a strip of 2 ft between two heights; the
// corner is on the left, or else on the right.
ImageF MakeQuoins(double low, double high, bool is_left, const Rgb& stone);
// A round window with louvres in a stone ring, for a square.
ImageF MakeOculus(const Rgb& stone);
// The coping under a gable's two slopes, for a rectangle of this width and height, feet.
ImageF MakeCoping(double width, double height, const Rgb& stone);

}  // namespace groundglass
