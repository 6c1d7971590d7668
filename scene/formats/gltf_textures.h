// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/formats/own_tiny_gltf.h"
#include "scene/textured_model.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace groundglass {

// The image of a texture, -1 for none; `unread` gets the extension that it lies in where that is
// not read here.
int FindTextureImage(const tinygltf::Texture& texture, std::set<std::string>& unread);

// Decodes the images that faces use, in order, and turns shares of the picture into texels: the
// faces' pages are images before. Faces whose picture cannot be had are grey, with a warning.
void DecodeGltfPages(const tinygltf::Model& gltf,
                     const std::filesystem::path& file,
                     TexturedModel& textured,
                     std::vector<std::string>& warnings);

}  // namespace groundglass
