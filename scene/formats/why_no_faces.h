// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/formats/own_tiny_gltf.h"

#include <filesystem>
#include <string>

namespace groundglass {

// Of an OBJ or STL that was read and has no face: what it holds in place of faces, and what to do.
std::string WhyNoFaces(const std::filesystem::path& file);

// The same of a glTF; `scene`: the one that was read.
std::string WhyNoGltfFaces(const tinygltf::Model& gltf, int scene);

}  // namespace groundglass
