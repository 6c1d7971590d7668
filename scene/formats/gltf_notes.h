// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/formats/own_tiny_gltf.h"
#include "scene/polygon_model.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What glTF has no place for stands in its `extras`, so that our reader gives the same model back
// that WriteGlb was given.

// Unit, sigma and georeference. What a file does not say, or says amiss, stays as the model has it.
void WriteGltfNotes(const PolygonModel& model, tinygltf::Model& gltf);
void ReadGltfNotes(const tinygltf::Model& gltf, PolygonModel& model);

// A face that was written as triangles; its corners are consecutive vertices.
struct GltfPolygon {
  std::vector<int> corners;  // vertices of the primitive
  std::string name;
  int place = -1;  // among the faces of the model that was written
  int number = 0;  // in that model's own file
};
void WriteGltfPolygons(const PolygonModel& model,
                       const std::vector<int>& faces,
                       tinygltf::Primitive& primitive);
// Nothing if the file is not ours, or has been changed since.
std::optional<std::vector<GltfPolygon>> ReadGltfPolygons(const tinygltf::Primitive& primitive,
                                                         size_t num_vertices);

}  // namespace groundglass
