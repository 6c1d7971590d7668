// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/atomic_file.h"
#include "scene/textured_model.h"

#include <filesystem>
#include <vector>

namespace groundglass {

// A textured model as CityJSON 2.0 (cityjson/specs): one building, its faces as surfaces with
// names and kinds (roof, wall, ground, by their slope), vertices in tenths of a millimetre, in
// metres, and its texture pages as JPEG beside the file. Faces with holes keep them.
std::vector<FileToWrite> FormatCityJson(const TexturedModel& textured,
                                        const std::filesystem::path& out);

}  // namespace groundglass
