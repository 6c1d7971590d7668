// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/formats/own_tiny_gltf.h"

#include <filesystem>

namespace groundglass {

// A glTF or GLB file, whatever it is called. Pictures keep their bytes as they are: they are
// decoded only if somebody asks. Throws Error that says what is damaged.
tinygltf::Model ParseGltf(const std::filesystem::path& file);

}  // namespace groundglass
