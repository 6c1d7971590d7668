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

}  // namespace groundglass
