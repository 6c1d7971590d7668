// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "scene/face_outline.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/gltf_notes.h"
#include "scene/formats/material_library.h"
#include "scene/formats/own_tiny_gltf.h"
#include "scene/formats/textured_model_io.h"

#include <cstring>
#include <map>
#include <sstream>

namespace groundglass {
namespace {

Eigen::Vector3d GltfFromWorld(const Eigen::Vector3d& point) {
  return {point.x(), point.z(), -point.y()};
}

// Beyond this many metres from the origin, single precision is coarser than a tenth of a
// millimetre; the whole model is then moved by its node.
constexpr double kFarFromOriginMetres = 1000;

// The format requires the bounds of positions.
void SetPositionBounds(const std::vector<float>& positions, tinygltf::Accessor& accessor) {
  Eigen::Map<const Eigen::Matrix<float, 3, Eigen::Dynamic>> points(
      positions.data(), 3, static_cast<Eigen::Index>(positions.size() / 3));
  const Eigen::Vector3f low = points.rowwise().minCoeff();
  const Eigen::Vector3f high = points.rowwise().maxCoeff();
  accessor.minValues = {low.x(), low.y(), low.z()};
  accessor.maxValues = {high.x(), high.y(), high.z()};
}

class GlbWriter {
 public:
  GlbWriter(const TexturedModel& textured, const JpegPages& pages)
      : textured_(textured), pages_(pages) {}

  std::string Write() {
    gltf_.asset.version = "2.0";
    gltf_.asset.generator = "groundglass";
    WriteGltfNotes(textured_.model, gltf_);
    gltf_.buffers.emplace_back();
    const Box bounds = ComputeBounds(textured_.model);
    const double scale = MetresPerUnit(textured_.model.unit);
    const double farthest_m =
        scale * std::max(bounds.min.cwiseAbs().maxCoeff(), bounds.max.cwiseAbs().maxCoeff());
    if (farthest_m > kFarFromOriginMetres) {
      center_m_ = (scale * GltfFromWorld(bounds.Center())).array().round();
    }

    AddMaterials();
    std::map<int, std::vector<int>> faces_of_page;
    for (size_t i = 0; i < textured_.model.faces.size(); ++i) {
      const FaceTexture& texture = textured_.faces[i];
      faces_of_page[texture.page].push_back(static_cast<int>(i));
    }
    tinygltf::Mesh mesh;
    mesh.name = "model";
    for (const auto& [page, faces] : faces_of_page) {
      mesh.primitives.push_back(MakePrimitive(page, faces));
    }
    gltf_.meshes.push_back(std::move(mesh));
    tinygltf::Node node;
    node.name = "model";
    node.mesh = 0;
    if (!center_m_.isZero()) node.translation = {center_m_.x(), center_m_.y(), center_m_.z()};
    gltf_.nodes.push_back(std::move(node));
    gltf_.scenes.emplace_back().nodes = {0};
    gltf_.defaultScene = 0;

    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    writer.WriteGltfSceneToStream(&gltf_, stream, false, true);
    return std::move(stream).str();
  }

 private:
  // Material n shows page n; the last one is plain grey.
  void AddMaterials() {
    tinygltf::Sampler sampler;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.wrapS = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    if (!textured_.pages.empty()) gltf_.samplers.push_back(sampler);
    for (size_t i = 0; i < textured_.pages.size(); ++i) {
      const std::vector<uint8_t>& jpeg = pages_[i];
      tinygltf::Image image;
      image.name = "page_" + std::to_string(i);
      image.mimeType = "image/jpeg";
      image.bufferView = AddBytes(jpeg.data(), jpeg.size(), 0);
      gltf_.images.push_back(std::move(image));
      tinygltf::Texture texture;
      texture.sampler = 0;
      texture.source = static_cast<int>(i);
      gltf_.textures.push_back(std::move(texture));
      tinygltf::Material material;
      material.name = "page_" + std::to_string(i);
      material.pbrMetallicRoughness.baseColorTexture.index = static_cast<int>(i);
      material.pbrMetallicRoughness.metallicFactor = 0;
      material.doubleSided = true;
      // The photographs hold the light already.
      material.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object());
      gltf_.materials.push_back(std::move(material));
    }
    if (!textured_.pages.empty()) gltf_.extensionsUsed.push_back("KHR_materials_unlit");
    tinygltf::Material grey;
    grey.name = kNoPhotographMaterial;
    grey.pbrMetallicRoughness.baseColorFactor = {0.5, 0.5, 0.5, 1};
    grey.pbrMetallicRoughness.metallicFactor = 0;
    grey.doubleSided = true;
    gltf_.materials.push_back(std::move(grey));
  }

  // Appends to the one buffer, aligned to four bytes; returns the new buffer view.
  int AddBytes(const void* bytes, size_t size, int target) {
    std::vector<unsigned char>& data = gltf_.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
    const unsigned char* begin = static_cast<const unsigned char*>(bytes);
    data.insert(data.end(), begin, begin + size);
    gltf_.bufferViews.push_back(std::move(view));
    return static_cast<int>(gltf_.bufferViews.size()) - 1;
  }

  int AddFloats(const std::vector<float>& values, int type, int width) {
    tinygltf::Accessor accessor;
    accessor.bufferView =
        AddBytes(values.data(), values.size() * sizeof(float), TINYGLTF_TARGET_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = type;
    accessor.count = values.size() / static_cast<size_t>(width);
    gltf_.accessors.push_back(std::move(accessor));
    return static_cast<int>(gltf_.accessors.size()) - 1;
  }

  // A primitive's vertices, three or two numbers for each, and its triangles.
  struct Vertices {
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<float> uv;
    std::vector<uint32_t> indices;
  };

  tinygltf::Primitive MakePrimitive(int page, const std::vector<int>& faces) {
    Vertices vertices;
    for (const int face : faces) AppendFace(page, face, vertices);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = page >= 0 ? page : static_cast<int>(gltf_.materials.size()) - 1;
    primitive.attributes["POSITION"] = AddFloats(vertices.positions, TINYGLTF_TYPE_VEC3, 3);
    SetPositionBounds(vertices.positions, gltf_.accessors.back());
    primitive.attributes["NORMAL"] = AddFloats(vertices.normals, TINYGLTF_TYPE_VEC3, 3);
    if (page >= 0) {
      primitive.attributes["TEXCOORD_0"] = AddFloats(vertices.uv, TINYGLTF_TYPE_VEC2, 2);
    }
    primitive.indices = AddIndices(vertices.indices);
    WriteGltfPolygons(textured_.model, faces, primitive);
    return primitive;
  }

  // A face has vertices of its own, one for each corner, in order.
  void AppendFace(int page, int index, Vertices& vertices) const {
    const PolygonModel& model = textured_.model;
    const double scale = MetresPerUnit(model.unit);
    const Face& face = model.faces[static_cast<size_t>(index)];
    const uint32_t first = static_cast<uint32_t>(vertices.positions.size() / 3);
    const Eigen::Vector3f normal =
        GltfFromWorld(ComputeFacePlane(model, index).normal_in_world).cast<float>();
    for (size_t k = 0; k < face.points.size(); ++k) {
      const Eigen::Vector3d& point = model.points_in_world[static_cast<size_t>(face.points[k])];
      const Eigen::Vector3f position =
          (scale * GltfFromWorld(point) - center_m_).cast<float>().array() + 0.0f;  // no -0
      vertices.positions.insert(vertices.positions.end(),
                                {position.x(), position.y(), position.z()});
      vertices.normals.insert(vertices.normals.end(), {normal.x(), normal.y(), normal.z()});
      if (page < 0) continue;
      // Both have their origin at the top left corner, so there is nothing to flip.
      const Image8& picture = textured_.pages[static_cast<size_t>(page)].srgb8;
      const Eigen::Vector2d& texel = textured_.faces[static_cast<size_t>(index)].corners_texel[k];
      vertices.uv.push_back(static_cast<float>(texel.x() / picture.width));
      vertices.uv.push_back(static_cast<float>(texel.y() / picture.height));
    }
    for (const std::array<int, 3>& triangle : TriangulateCorners(model, index)) {
      for (const int corner : triangle) {
        vertices.indices.push_back(first + static_cast<uint32_t>(corner));
      }
    }
  }

  int AddIndices(const std::vector<uint32_t>& indices) {
    tinygltf::Accessor accessor;
    accessor.bufferView = AddBytes(
        indices.data(), indices.size() * sizeof(uint32_t), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.count = indices.size();
    gltf_.accessors.push_back(std::move(accessor));
    return static_cast<int>(gltf_.accessors.size()) - 1;
  }

  const TexturedModel& textured_;
  const JpegPages& pages_;
  tinygltf::Model gltf_;
  Eigen::Vector3d center_m_ = Eigen::Vector3d::Zero();
};

}  // namespace

void WriteGlb(const std::filesystem::path& file,
              const TexturedModel& model,
              const JpegPages& pages) {
  if (model.model.faces.empty() || model.faces.size() != model.model.faces.size()) {
    throw Error(file, "cannot write a model without faces");
  }
  WriteFileAtomically(file,
                      pages.empty() ? GlbWriter(model, EncodePages(model)).Write()
                                    : GlbWriter(model, pages).Write());
}

}  // namespace groundglass
