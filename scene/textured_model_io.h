// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image_io.h"
#include "scene/textured_model.h"

#include <filesystem>
#include <string>

namespace groundglass {

// GLB: metres, y up, pages as JPEG inside; faces without texture get a plain grey material.
void WriteGlb(const std::filesystem::path& file, const TexturedModel& model);

// OBJ + MTL + STEM_0.jpg ...: `world`, the model's unit, polygons kept whole.
void WriteTexturedObj(const std::filesystem::path& file,
                      const TexturedModel& model,
                      const std::string& image_extension = ".jpg",
                      const ImageWriteOptions& image_options = {});

// Reads .glb, .gltf or .obj with its textures, or any plain model (no pages then).
TexturedModel ReadTexturedModel(const std::filesystem::path& file);

}  // namespace groundglass
