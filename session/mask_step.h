// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/image_io.h"
#include "scene/image.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// A part of a mask (ignore_mask.h) as a step leaves it. Its pixels are told as they are and not as
// differences, so that steps can be put onto a mask again without harm.
struct MaskStep {
  int x = 0;  // of the part's first pixel
  int y = 0;
  int width = 0;
  int height = 0;
  // Pixels of the part, row after row: so many that are looked at (perhaps none), so many that are
  // ignored, and so on by turns.
  std::vector<int> runs;

  bool operator==(const MaskStep&) const = default;
};

// The smallest rectangle outside of which two masks of one size are equal; nothing: they are equal.
struct MaskPart {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};
std::optional<MaskPart> FindChangedPart(const Image8& before, const Image8& after);

MaskStep MaskStepOf(const Image8& ignore, const MaskPart& part);
// Whether its part lies in a mask of this size, and its runs are as many pixels as that has.
bool Fits(const MaskStep& step, const ImageSize& size);
// step: one that fits.
void PutMaskStep(const MaskStep& step, Image8& ignore);

// One line of numbers, and back; the second throws Error.
std::string FormatMaskStep(const MaskStep& step);
MaskStep ParseMaskStep(std::string_view line);

}  // namespace groundglass
