// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/image_io.h"

#include <filesystem>

namespace groundglass {

// A photograph's mask of what is not to be looked at (people, trees, a slide's mount): 1 channel,
// 255 = ignore, 0 = look. The one rule for registration and texturing:
//   white is what is at least half as bright as the file's format can say, whatever its bits;
//   of a colour, its brightest channel counts, so that red paint is white too;
//   what is painted on a transparent ground is white where it is opaque;
//   a file whose only codes are 0 and 1, or in 16 bits 0 and 255, counts 1 or 255 as white.
// Throws Error if it cannot be read, or does not have its photograph's size.
Image8 ReadIgnoreMask(const std::filesystem::path& file, const ImageSize& photograph);

// Throws Error if a mask's size is not its photograph's, with both.
void CheckMaskSize(const std::filesystem::path& file,
                   const ImageSize& mask,
                   const ImageSize& photograph);

}  // namespace groundglass
