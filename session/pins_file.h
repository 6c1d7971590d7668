// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "session/pins.h"

#include <filesystem>
#include <map>
#include <string>

namespace groundglass {

// Pins of a scene's photographs as a points file (docs/points-file.md), which `register --points`
// reads: three or more points that are used, a line each. What such a file has no words for stands
// in its comments, for the window to read again: "% check s5 ...", "% off s5 ...", "% few s5 ..."
// (points of a photograph with fewer than three), "% line s5 ...".

// The pins of every photograph in the text. Throws Error naming file and line.
std::map<std::string, Pins> ParsePins(const std::string& text, const std::filesystem::path& name);

// The text with this photograph's lines replaced by these pins; other lines stay as they are, byte
// for byte. Empty if nothing is left but blanks.
std::string ReplacePins(const std::string& text, const std::string& photograph, const Pins& pins);

}  // namespace groundglass
