// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/gltf_shapes.h"

#include "scene/formats/gltf_accessor.h"

namespace groundglass {

Eigen::Matrix4d GltfNodeTransform(const tinygltf::Node& node) {
  Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
  if (node.matrix.size() == 16) {
    transform = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    return transform;
  }
  if (node.rotation.size() == 4) {
    const Eigen::Quaterniond rotation(
        node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    transform.topLeftCorner<3, 3>() = rotation.normalized().toRotationMatrix();
  }
  if (node.scale.size() == 3) {
    transform.topLeftCorner<3, 3>() *=
        Eigen::Vector3d(node.scale[0], node.scale[1], node.scale[2]).asDiagonal();
  }
  if (node.translation.size() == 3) {
    transform.topRightCorner<3, 1>() =
        Eigen::Vector3d(node.translation[0], node.translation[1], node.translation[2]);
  }
  return transform;
}

std::vector<std::array<int, 3>> GltfTriangles(const tinygltf::Model& gltf,
                                              const tinygltf::Primitive& primitive,
                                              size_t num_vertices,
                                              const std::filesystem::path& file) {
  std::vector<int> corners;
  if (primitive.indices >= 0) {
    for (const double value : ReadGltfAccessor(gltf, primitive.indices, 1, file)) {
      if (!(value >= 0 && value < static_cast<double>(num_vertices))) {
        FailGltf(file, "a triangle uses a vertex that there is not");
      }
      corners.push_back(static_cast<int>(value));
    }
  } else {
    for (size_t i = 0; i < num_vertices; ++i) corners.push_back(static_cast<int>(i));
  }
  std::vector<std::array<int, 3>> triangles;
  if (primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1) {
    for (size_t i = 0; i + 2 < corners.size(); i += 3) {
      triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
  } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (size_t i = 0; i + 2 < corners.size(); ++i) {
      const size_t odd = i % 2;
      const std::array<int, 3> t = {corners[i], corners[i + 1 + odd], corners[i + 2 - odd]};
      // Doubled corners only turn the strip around.
      if (t[0] != t[1] && t[1] != t[2] && t[0] != t[2]) triangles.push_back(t);
    }
  } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
    for (size_t i = 1; i + 1 < corners.size(); ++i) {
      triangles.push_back({corners[0], corners[i], corners[i + 1]});
    }
  }
  return triangles;  // points and lines have none
}

}  // namespace groundglass
