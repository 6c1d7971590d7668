// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

namespace groundglass {

// Writes each face's number where the face is widest in the picture, as large as fits there, and
// no number where none is legible. labels: the picture's size, 0 for no face.
void DrawFaceNumbers(Image8& srgb8, const Image16& labels);

}  // namespace groundglass
