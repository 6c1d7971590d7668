// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/gltf_extensions.h"

#include "scene/formats/gltf_accessor.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

// Read here.
constexpr std::array kKnown = {"KHR_mesh_quantization", "KHR_texture_transform", "CESIUM_RTC"};
// Only say how surfaces look in other lights, or what they mean: the shape is the same without.
constexpr std::array kHarmlessStarts = {"KHR_materials_",
                                        "KHR_lights_",
                                        "KHR_xmp",
                                        "KHR_texture_basisu",
                                        "EXT_lights_",
                                        "EXT_texture_",
                                        "EXT_mesh_features",
                                        "EXT_feature_metadata",
                                        "EXT_instance_features",
                                        "EXT_structural_metadata",
                                        "ADOBE_materials_",
                                        "MSFT_texture_dds",
                                        "CESIUM_primitive_outline"};

bool IsReadable(const std::string& name) {
  const auto starts = [&](const char* start) { return name.starts_with(start); };
  return std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end() ||
         std::any_of(kHarmlessStarts.begin(), kHarmlessStarts.end(), starts);
}

// What to do about the ones that are met most.
std::string RemedyFor(const std::string& name) {
  if (name == "KHR_draco_mesh_compression") {
    return "its meshes are compressed by Draco (" + name +
           "); write it again without compression (in Blender's export: Compression off), or "
           "unpack it with 'gltf-transform copy IN.glb OUT.glb'";
  }
  if (name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression") {
    return "its meshes are compressed by meshoptimizer (" + name +
           "); write it again without, or unpack it with 'gltf-transform copy IN.glb OUT.glb'";
  }
  return "it needs the extension " + Quote(name) +
         ", which is not known here; write it again without";
}

// These change the shape where they are used, needed or not.
constexpr std::array kShapeChanging = {"EXT_mesh_gpu_instancing", "MSFT_lod"};

}  // namespace

void CheckGltfExtensions(const tinygltf::Model& gltf,
                         const std::filesystem::path& file,
                         std::vector<std::string>& warnings) {
  for (const std::string& name : gltf.extensionsRequired) {
    if (!IsReadable(name)) FailGltf(file, RemedyFor(name));
  }
  for (const std::string& name : gltf.extensionsUsed) {
    if (std::find(kShapeChanging.begin(), kShapeChanging.end(), name) == kShapeChanging.end()) {
      continue;
    }
    warnings.push_back(
        Error(file, "the extension " + Quote(name) + " is not read; parts may be missing").what());
  }
}

Eigen::Vector3d GltfOrigin(const tinygltf::Model& gltf, const std::filesystem::path& file) {
  const auto extension = gltf.extensions.find("CESIUM_RTC");
  if (extension == gltf.extensions.end()) return Eigen::Vector3d::Zero();
  const tinygltf::Value& value = extension->second;
  Eigen::Vector3d origin;
  if (!value.IsObject() || !value.Has("center") || !value.Get("center").IsArray() ||
      value.Get("center").ArrayLen() != 3) {
    FailGltf(file, "CESIUM_RTC has no center of three numbers");
  }
  for (int axis = 0; axis < 3; ++axis) {
    const tinygltf::Value& number = value.Get("center").Get(axis);
    if (!number.IsNumber() || !std::isfinite(number.GetNumberAsDouble())) {
      FailGltf(file, "CESIUM_RTC has no center of three numbers");
    }
    origin[axis] = number.GetNumberAsDouble();
  }
  return origin;
}

Eigen::Vector2d GltfTextureUse::operator*(const Eigen::Vector2d& uv) const {
  const Eigen::Vector2d scaled = uv.cwiseProduct(scale);
  const double c = std::cos(rotation_rad);
  const double s = std::sin(rotation_rad);
  // Counterclockwise, where v runs downwards.
  return offset + Eigen::Vector2d(c * scaled.x() + s * scaled.y(), c * scaled.y() - s * scaled.x());
}

GltfTextureUse FindTextureUse(const tinygltf::TextureInfo& texture) {
  GltfTextureUse use;
  use.texture_points = texture.texCoord;
  const auto extension = texture.extensions.find("KHR_texture_transform");
  if (extension == texture.extensions.end() || !extension->second.IsObject()) return use;
  const tinygltf::Value& value = extension->second;
  const auto read_pair = [&](const char* key, Eigen::Vector2d& pair) {
    if (!value.Has(key) || !value.Get(key).IsArray() || value.Get(key).ArrayLen() != 2) return;
    for (int i = 0; i < 2; ++i) {
      const tinygltf::Value& number = value.Get(key).Get(i);
      if (number.IsNumber()) pair[i] = number.GetNumberAsDouble();
    }
  };
  read_pair("offset", use.offset);
  read_pair("scale", use.scale);
  if (value.Has("rotation") && value.Get("rotation").IsNumber()) {
    use.rotation_rad = value.Get("rotation").GetNumberAsDouble();
  }
  if (value.Has("texCoord") && value.Get("texCoord").IsNumber()) {
    use.texture_points = value.Get("texCoord").GetNumberAsInt();
  }
  return use;
}

}  // namespace groundglass
