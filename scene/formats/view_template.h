// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/image_io.h"
#include "scene/length_unit.h"

#include <optional>
#include <string>

namespace groundglass {

// A view file to be filled in (docs/view-file.md): every key with what it means, `?` where a number
// is to be written, the aspect from the picture's size. Until then ReadView names what is missing.
// view_angle_deg: across the picture; left open without it. `how_known`: where it comes from, for
// its comment.
std::string FormatViewTemplate(const std::string& image_name,
                               const ImageSize& size,
                               LengthUnit unit,
                               const std::optional<double>& view_angle_deg,
                               const std::string& how_known = "");

// The angle across a frame of this aspect behind such a lens: the diagonal is what is the same.
double ViewAngleDegFromFocalLength(double focal_length_mm, double aspect);

}  // namespace groundglass
