// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/textured_model.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// A model's pages as JPEG files' bytes, for those who write more than one file of them.
using JpegPages = std::vector<std::vector<uint8_t>>;
JpegPages EncodePages(const TexturedModel& model);

// GLB: metres, y up, pages as JPEG inside (encoded here if `pages` is empty); faces without texture
// get a plain grey material.
void WriteGlb(const std::filesystem::path& file,
              const TexturedModel& model,
              const JpegPages& pages = {});

// OBJ + MTL + STEM_0.jpg ...: `world`, the model's unit, polygons kept whole. JPEG pages are
// encoded here if `pages` is empty.
void WriteTexturedObj(const std::filesystem::path& file,
                      const TexturedModel& model,
                      const std::string& image_extension = ".jpg",
                      const JpegPages& pages = {});

}  // namespace groundglass
