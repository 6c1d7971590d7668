// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/own_tiny_gltf.h"

#include <Eigen/Dense>

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// Error with the name of what the file cannot be read without and is not known here; a warning for
// what only its shape would differ by.
void CheckGltfExtensions(const tinygltf::Model& gltf,
                         const std::filesystem::path& file,
                         std::vector<std::string>& warnings);

// CESIUM_RTC: by how much all points are moved, in the file's frame.
Eigen::Vector3d GltfOrigin(const tinygltf::Model& gltf, const std::filesystem::path& file);

// Which texture points a texture takes, and how KHR_texture_transform moves them.
struct GltfTextureUse {
  int texture_points = 0;  // of TEXCOORD_n
  Eigen::Vector2d scale = Eigen::Vector2d::Ones();
  double rotation_rad = 0;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();

  Eigen::Vector2d operator*(const Eigen::Vector2d& uv) const;
};
GltfTextureUse FindTextureUse(const tinygltf::TextureInfo& texture);

}  // namespace groundglass
