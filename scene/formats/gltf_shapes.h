// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/formats/own_tiny_gltf.h"

#include <Eigen/Dense>

#include <array>
#include <filesystem>
#include <vector>

namespace groundglass {

// From the node's own axes to its parent's.
Eigen::Matrix4d GltfNodeTransform(const tinygltf::Node& node);

// The primitive's corners as triangles, whatever way it strings them; points and lines have none.
// Throws Error if one is a vertex that there is not.
std::vector<std::array<int, 3>> GltfTriangles(const tinygltf::Model& gltf,
                                              const tinygltf::Primitive& primitive,
                                              size_t num_vertices,
                                              const std::filesystem::path& file);

}  // namespace groundglass
