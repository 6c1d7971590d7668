// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/colour_page.h"
#include "scene/error.h"
#include "scene/formats/gltf_accessor.h"
#include "scene/formats/gltf_extensions.h"
#include "scene/formats/gltf_notes.h"
#include "scene/formats/gltf_parse.h"
#include "scene/formats/gltf_shapes.h"
#include "scene/formats/gltf_textures.h"
#include "scene/formats/material_library.h"
#include "scene/formats/mesh_io.h"
#include "scene/formats/why_no_faces.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace groundglass {
namespace {

// glTF is y up with z towards the viewer; `world` is z up.
Eigen::Vector3d WorldFromGltf(const Eigen::Vector3d& point) {
  return {point.x(), -point.z(), point.y()};
}

// Our faces were parted by page; puts them back in the order of the model that they were written
// from. own_order: the place there of each.
void RestoreOrder(const std::vector<int>& own_order,
                  TexturedModel& textured,
                  std::vector<int>& materials_of_faces) {
  std::vector<size_t> order(textured.faces.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(
      order.begin(), order.end(), [&](size_t a, size_t b) { return own_order[a] < own_order[b]; });
  std::vector<Face> faces;
  std::vector<FaceTexture> textures;
  std::vector<int> materials;
  for (const size_t i : order) {
    materials.push_back(materials_of_faces[i]);
    faces.push_back(std::move(textured.model.faces[i]));
    textures.push_back(std::move(textured.faces[i]));
  }
  textured.model.faces = std::move(faces);
  textured.faces = std::move(textures);
  materials_of_faces = std::move(materials);
}

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& file, std::optional<LengthUnit> unit)
      : file_(file), unit_(unit) {}

  MeshReading Read(MeshPages pages) {
    gltf_ = ParseGltf(file_);
    CheckGltfExtensions(gltf_, file_, reading_.warnings);
    origin_ = GltfOrigin(gltf_, file_);
    ReadNotes();
    const int scene_index = gltf_.defaultScene >= 0 ? gltf_.defaultScene : 0;
    if (gltf_.scenes.empty()) {
      Fail("it has no scene, which says what of it is shown; export it with what is visible");
    }
    for (const int node : At(gltf_.scenes, scene_index, "scene").nodes) {
      AppendNode(node, Eigen::Matrix4d::Identity(), 0);
    }
    if (result_.model.faces.empty()) throw Error(file_, WhyNoGltfFaces(gltf_, scene_index));
    RestoreOrder(own_order_, result_, materials_);
    if (pages != MeshPages::kNone) {
      TellUnreadTextures();
      DecodeGltfPages(gltf_, file_, result_, reading_.warnings);
    } else {
      for (FaceTexture& face : result_.faces) face = FaceTexture();
    }
    if (pages == MeshPages::kPicturesAndColours) LayColours();
    JoinIdenticalPoints(result_.model);
    return std::move(reading_);
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const { FailGltf(file_, message); }

  template <typename T>
  const T& At(const std::vector<T>& items, int index, const char* what) const {
    return GltfItem(items, index, what, file_);
  }

  // The unit that was asked for counts before the file's, whose sigma is converted.
  void ReadNotes() {
    PolygonModel& model = result_.model;
    model.unit = LengthUnit::kMetre;
    ReadGltfNotes(gltf_, model);
    if (unit_ && model.sigma) *model.sigma *= MetresPerUnit(model.unit) / MetresPerUnit(*unit_);
    if (unit_) model.unit = *unit_;
  }

  void AppendNode(int index, const Eigen::Matrix4d& parent, int depth) {
    constexpr int kDeepest = 64;  // a loop of nodes has no end
    if (depth > kDeepest) Fail("its nodes are nested too deeply");
    const tinygltf::Node& node = At(gltf_.nodes, index, "node");
    const Eigen::Matrix4d transform = parent * GltfNodeTransform(node);
    if (node.mesh >= 0) {
      const tinygltf::Mesh& mesh = At(gltf_.meshes, node.mesh, "mesh");
      TellWhatMovesIt(node, mesh);
      for (const tinygltf::Primitive& primitive : mesh.primitives) {
        AppendPrimitive(primitive, mesh.name, transform);
      }
    }
    for (const int child : node.children) AppendNode(child, transform, depth + 1);
  }

  // A building has no joints; what has is read as it was drawn.
  void TellWhatMovesIt(const tinygltf::Node& node, const tinygltf::Mesh& mesh) {
    const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
    const bool is_morphed =
        std::any_of(weights.begin(), weights.end(), [](double weight) { return weight != 0; });
    if (node.skin < 0 && !is_morphed) return;
    reading_.warnings.push_back(
        Error(
            file_,
            "mesh " + Quote(mesh.name) + (node.skin >= 0 ? " hangs on a skeleton" : " is morphed") +
                ", which is not read: it stands as it was drawn; export it with modifiers applied")
            .what());
  }

  std::vector<double> ReadAccessor(int index, int width) const {
    return ReadGltfAccessor(gltf_, index, width, file_);
  }

  void AppendPrimitive(const tinygltf::Primitive& primitive,
                       const std::string& mesh_name,
                       const Eigen::Matrix4d& transform) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return;
    // A mesh may come both ways, for programs that cannot unpack it.
    const bool is_there_unpacked =
        At(gltf_.accessors, position->second, "accessor").bufferView >= 0;
    if (primitive.extensions.count("KHR_draco_mesh_compression") > 0 && !is_there_unpacked) {
      Fail("a mesh is compressed by Draco (KHR_draco_mesh_compression); write it again without");
    }
    Vertices vertices;
    vertices.first = static_cast<int>(result_.model.points_in_world.size());
    vertices.count = AppendPoints(ReadAccessor(position->second, 3), transform);
    vertices.material = primitive.material;
    vertices.texture = TextureImage(primitive.material);
    vertices.uv = ReadTexturePoints(primitive, vertices);
    // A mirroring transform turns every triangle over.
    const bool is_mirrored = transform.topLeftCorner<3, 3>().determinant() < 0;
    const auto polygons = is_mirrored ? std::nullopt : ReadGltfPolygons(primitive, vertices.count);
    if (polygons) {
      for (const GltfPolygon& polygon : *polygons) {
        AppendFace(vertices, polygon.corners, polygon.name, polygon.place);
        result_.model.faces.back().number = polygon.number;
      }
      return;
    }
    for (const std::array<int, 3>& t : GltfTriangles(gltf_, primitive, vertices.count, file_)) {
      AppendFace(
          vertices,
          is_mirrored ? std::vector<int>{t[0], t[2], t[1]} : std::vector<int>{t[0], t[1], t[2]},
          mesh_name,
          -1);
    }
  }

  // A primitive's vertices, as they were taken over.
  struct Vertices {
    int first = 0;  // of the model's points
    size_t count = 0;
    int material = -1;
    int texture = -1;
    std::vector<double> uv;  // two numbers for each; empty without texture
  };

  // Returns how many there are.
  size_t AppendPoints(const std::vector<double>& coordinates, const Eigen::Matrix4d& transform) {
    PolygonModel& model = result_.model;
    const size_t num_vertices = coordinates.size() / 3;
    const double units_per_metre = 1 / MetresPerUnit(model.unit);
    for (size_t i = 0; i < num_vertices; ++i) {
      const Eigen::Vector4d point(
          coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2], 1);
      const Eigen::Vector3d placed = (transform * point).head<3>() + origin_;
      model.points_in_world.push_back(
          (units_per_metre * WorldFromGltf(placed)).unaryExpr(&OrNoPlace));
    }
    return num_vertices;
  }

  // Where the vertices lie on their texture; empty if they do not.
  std::vector<double> ReadTexturePoints(const tinygltf::Primitive& primitive,
                                        const Vertices& vertices) const {
    if (vertices.texture < 0) return {};
    const GltfTextureUse use = FindTextureUse(
        At(gltf_.materials, primitive.material, "material").pbrMetallicRoughness.baseColorTexture);
    const auto texture_points =
        primitive.attributes.find("TEXCOORD_" + std::to_string(use.texture_points));
    if (texture_points == primitive.attributes.end()) return {};
    std::vector<double> uv = ReadAccessor(texture_points->second, 2);
    if (uv.size() / 2 != vertices.count) Fail("texture coordinates do not match its points");
    for (size_t i = 0; i + 1 < uv.size(); i += 2) {
      const Eigen::Vector2d moved = use * Eigen::Vector2d(uv[i], uv[i + 1]);
      if (!moved.allFinite()) Fail("a texture coordinate is not a finite number");
      uv[i] = moved.x();
      uv[i + 1] = moved.y();
    }
    return uv;
  }

  // place: of the face in the model that the file was written from; -1 unknown.
  void AppendFace(const Vertices& vertices,
                  const std::vector<int>& corners,
                  const std::string& name,
                  int place) {
    PolygonModel& model = result_.model;
    Face face;
    face.name = name;
    face.number = static_cast<int>(model.faces.size()) + 1;
    FaceTexture face_texture;
    if (!vertices.uv.empty()) face_texture.page = vertices.texture;
    for (const int corner : corners) {
      face.points.push_back(vertices.first + corner);
      if (!vertices.uv.empty()) {
        const size_t at = 2 * static_cast<size_t>(corner);
        face_texture.corners_texel.emplace_back(vertices.uv[at], vertices.uv[at + 1]);
      }
    }
    model.faces.push_back(std::move(face));
    result_.faces.push_back(std::move(face_texture));
    own_order_.push_back(place);
    materials_.push_back(vertices.material);
  }

  // The image of a material's base colour; -1 for none.
  int TextureImage(int material) {
    if (material < 0) return -1;
    const int index =
        At(gltf_.materials, material, "material").pbrMetallicRoughness.baseColorTexture.index;
    if (index < 0) return -1;
    return FindTextureImage(At(gltf_.textures, index, "texture"), unread_textures_);
  }

  // Nothing for the grey with which our own files mark faces that no photograph shows.
  std::optional<std::array<float, 3>> BaseColour(int material) const {
    if (material < 0) return std::nullopt;
    const tinygltf::Material& found = At(gltf_.materials, material, "material");
    const std::vector<double>& factor = found.pbrMetallicRoughness.baseColorFactor;
    // One that is to have a picture stays grey without it.
    const bool has_picture = found.pbrMetallicRoughness.baseColorTexture.index >= 0;
    if (has_picture || found.name == kNoPhotographMaterial || factor.size() < 3) {
      return std::nullopt;
    }
    std::array<float, 3> linear = {};
    for (size_t c = 0; c < linear.size(); ++c) linear[c] = static_cast<float>(factor[c]);
    return linear;
  }

  // Faces without a picture get their material's colour; after the pictures.
  void LayColours() {
    const int page = static_cast<int>(result_.pages.size());
    ColourPage colours;
    for (size_t i = 0; i < result_.faces.size(); ++i) {
      if (result_.faces[i].page >= 0) continue;
      if (const auto linear = BaseColour(materials_[i])) {
        result_.faces[i] = colours.Add(*linear, page, result_.model.faces[i].points.size());
      }
    }
    if (!colours.IsEmpty()) result_.pages.push_back(colours.Page());
  }

  void TellUnreadTextures() {
    for (const std::string& name : unread_textures_) {
      reading_.warnings.push_back(
          Error(file_,
                "pictures of the kind " + Quote(name) + " are not read; their faces are grey")
              .what());
    }
  }

  std::filesystem::path file_;
  std::optional<LengthUnit> unit_;
  tinygltf::Model gltf_;
  MeshReading reading_;
  TexturedModel& result_ = reading_.textured;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();  // CESIUM_RTC
  std::set<std::string> unread_textures_;
  std::vector<int> materials_;  // of each face; -1: none
  std::vector<int> own_order_;  // of each face in the model it was written from; -1 unknown
};

}  // namespace

MeshReading ReadGltf(const std::filesystem::path& file,
                     std::optional<LengthUnit> unit,
                     MeshPages pages) {
  return GltfReader(file, unit).Read(pages);
}

}  // namespace groundglass
