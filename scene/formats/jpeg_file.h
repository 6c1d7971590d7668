// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <filesystem>

namespace groundglass {

// How much of a JPEG's picture its file holds. The library that decodes it fills what is missing
// with grey and says nothing.
enum class JpegState {
  kWhole,
  kNoEndMark,  // every pixel is there, but not the mark that says so
  kIncomplete  // cut short, or damaged between
};

// Looks for the end mark, and decodes the file only if there is none, or if `look_closely`.
JpegState FindJpegState(const std::filesystem::path& file, bool look_closely = false);

// A JPEG of four inks, which programs for print write: the amounts of cyan, magenta, yellow and
// black, 255 = full. Throws Error if it cannot be decoded.
Image8 ReadJpegInks(const std::filesystem::path& file);

}  // namespace groundglass
