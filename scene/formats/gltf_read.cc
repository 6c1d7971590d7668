// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "scene/formats/gltf_accessor.h"
#include "scene/formats/gltf_extensions.h"
#include "scene/formats/gltf_parse.h"
#include "scene/formats/gltf_textures.h"
#include "scene/formats/mesh_io.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace groundglass {
namespace {

// glTF is y up with z towards the viewer; `world` is z up.
Eigen::Vector3d WorldFromGltf(const Eigen::Vector3d& point) {
  return {point.x(), -point.z(), point.y()};
}

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& file, std::optional<LengthUnit> unit)
      : file_(file), unit_(unit) {}

  MeshReading Read(bool with_pages) {
    gltf_ = ParseGltf(file_);
    CheckGltfExtensions(gltf_, file_, reading_.warnings);
    origin_ = GltfOrigin(gltf_, file_);
    ReadOwnNotes();
    const int scene_index = gltf_.defaultScene >= 0 ? gltf_.defaultScene : 0;
    if (gltf_.scenes.empty()) {
      Fail("it has no scene");
    }
    for (const int node : At(gltf_.scenes, scene_index, "scene").nodes) {
      AppendNode(node, Eigen::Matrix4d::Identity(), 0);
    }
    RestoreOrder();
    if (with_pages) {
      TellUnreadTextures();
      DecodeGltfPages(gltf_, file_, result_, reading_.warnings);
    } else {
      for (FaceTexture& face : result_.faces) face = FaceTexture();
    }
    JoinIdenticalPoints(result_.model);
    return std::move(reading_);
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const { FailGltf(file_, message); }

  template <typename T>
  const T& At(const std::vector<T>& items, int index, const char* what) const {
    return GltfItem(items, index, what, file_);
  }

  // What a file written by WriteGlb says beyond the format.
  void ReadOwnNotes() {
    PolygonModel& model = result_.model;
    model.unit = LengthUnit::kMetre;
    const tinygltf::Value& notes = gltf_.asset.extras;
    if (notes.IsObject() && notes.Has("groundglass_unit")) {
      const tinygltf::Value& unit = notes.Get("groundglass_unit");
      if (unit.IsString()) model.unit = FindUnit(unit.Get<std::string>()).value_or(model.unit);
    }
    if (notes.IsObject() && notes.Has("groundglass_origin")) {
      const tinygltf::Value& origin = notes.Get("groundglass_origin");
      if (origin.IsArray() && origin.ArrayLen() == 4) {
        model.georeference = Georeference{origin.Get(0).GetNumberAsDouble(),
                                          origin.Get(1).GetNumberAsDouble(),
                                          origin.Get(2).GetNumberAsDouble(),
                                          origin.Get(3).GetNumberAsDouble()};
      }
    }
    if (notes.IsObject() && notes.Has("groundglass_sigma")) {
      const tinygltf::Value& sigma = notes.Get("groundglass_sigma");
      if (sigma.IsNumber() && sigma.GetNumberAsDouble() > 0) {
        model.sigma = sigma.GetNumberAsDouble();
      }
    }
    if (unit_ && model.sigma) *model.sigma *= MetresPerUnit(model.unit) / MetresPerUnit(*unit_);
    if (unit_) model.unit = *unit_;
  }

  Eigen::Matrix4d NodeTransform(const tinygltf::Node& node) const {
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

  void AppendNode(int index, const Eigen::Matrix4d& parent, int depth) {
    constexpr int kDeepest = 64;  // a loop of nodes has no end
    if (depth > kDeepest) Fail("its nodes are nested too deeply");
    const tinygltf::Node& node = At(gltf_.nodes, index, "node");
    const Eigen::Matrix4d transform = parent * NodeTransform(node);
    if (node.mesh >= 0) {
      const tinygltf::Mesh& mesh = At(gltf_.meshes, node.mesh, "mesh");
      for (const tinygltf::Primitive& primitive : mesh.primitives) {
        AppendPrimitive(primitive, mesh.name, transform);
      }
    }
    for (const int child : node.children) AppendNode(child, transform, depth + 1);
  }

  std::vector<double> ReadAccessor(int index, int width) const {
    return ReadGltfAccessor(gltf_, index, width, file_);
  }

  // The primitive's corners as triangles, whatever way it strings them.
  std::vector<std::array<int, 3>> Triangles(const tinygltf::Primitive& primitive,
                                            size_t num_vertices) const {
    std::vector<int> corners;
    if (primitive.indices >= 0) {
      for (const double value : ReadAccessor(primitive.indices, 1)) {
        if (!(value >= 0 && value < static_cast<double>(num_vertices))) {
          Fail("a triangle uses a vertex that there is not");
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

  void AppendPrimitive(const tinygltf::Primitive& primitive,
                       const std::string& mesh_name,
                       const Eigen::Matrix4d& transform) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return;
    if (primitive.extensions.count("KHR_draco_mesh_compression") > 0) {
      Fail("a mesh is compressed by Draco (KHR_draco_mesh_compression); write it again without");
    }
    const std::vector<double> coordinates = ReadAccessor(position->second, 3);
    const size_t num_vertices = coordinates.size() / 3;
    PolygonModel& model = result_.model;
    const int first = static_cast<int>(model.points_in_world.size());
    const double units_per_metre = 1 / MetresPerUnit(model.unit);
    for (size_t i = 0; i < num_vertices; ++i) {
      const Eigen::Vector4d point(
          coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2], 1);
      const Eigen::Vector3d placed = (transform * point).head<3>() + origin_;
      if (!placed.allFinite()) Fail("a point's coordinates are not finite numbers");
      model.points_in_world.push_back(units_per_metre * WorldFromGltf(placed));
    }

    std::vector<double> uv;
    const int texture = TextureImage(primitive.material);
    if (texture >= 0) {
      const GltfTextureUse use = FindTextureUse(At(gltf_.materials, primitive.material, "material")
                                                    .pbrMetallicRoughness.baseColorTexture);
      const auto texture_points =
          primitive.attributes.find("TEXCOORD_" + std::to_string(use.texture_points));
      if (texture_points != primitive.attributes.end()) {
        uv = ReadAccessor(texture_points->second, 2);
        if (uv.size() / 2 != num_vertices) Fail("texture coordinates do not match its points");
      }
      for (size_t i = 0; i + 1 < uv.size(); i += 2) {
        const Eigen::Vector2d moved = use * Eigen::Vector2d(uv[i], uv[i + 1]);
        if (!moved.allFinite()) Fail("a texture coordinate is not a finite number");
        uv[i] = moved.x();
        uv[i + 1] = moved.y();
      }
    }
    const auto append_face = [&](const std::vector<int>& corners, const std::string& name) {
      Face face;
      face.name = name;
      face.number = static_cast<int>(model.faces.size()) + 1;
      FaceTexture face_texture;
      if (!uv.empty()) face_texture.page = texture;
      for (const int corner : corners) {
        face.points.push_back(first + corner);
        if (!uv.empty()) {
          const size_t at = 2 * static_cast<size_t>(corner);
          face_texture.corners_texel.emplace_back(uv[at], uv[at + 1]);
        }
      }
      model.faces.push_back(std::move(face));
      result_.faces.push_back(std::move(face_texture));
    };
    // A mirroring transform turns every triangle over.
    const bool is_mirrored = transform.topLeftCorner<3, 3>().determinant() < 0;
    if (!is_mirrored && AppendOwnPolygons(primitive, num_vertices, append_face)) return;
    for (const std::array<int, 3>& t : Triangles(primitive, num_vertices)) {
      append_face(
          is_mirrored ? std::vector<int>{t[0], t[2], t[1]} : std::vector<int>{t[0], t[1], t[2]},
          mesh_name);
      own_order_.push_back(-1);
    }
  }

  // The polygons that WriteGlb noted beside its triangles: each face's corners are consecutive
  // vertices. False if the file is not ours, or has been changed since.
  template <typename AppendFace>
  bool AppendOwnPolygons(const tinygltf::Primitive& primitive,
                         size_t num_vertices,
                         const AppendFace& append_face) {
    const tinygltf::Value& notes = primitive.extras;
    if (!notes.IsObject() || !notes.Has("groundglass_faces") || !notes.Has("groundglass_corners") ||
        !notes.Has("groundglass_names")) {
      return false;
    }
    const tinygltf::Value& faces = notes.Get("groundglass_faces");
    const tinygltf::Value& corners = notes.Get("groundglass_corners");
    const tinygltf::Value& names = notes.Get("groundglass_names");
    if (!faces.IsArray() || !corners.IsArray() || !names.IsArray() ||
        faces.ArrayLen() != corners.ArrayLen() || faces.ArrayLen() != names.ArrayLen()) {
      return false;
    }
    const tinygltf::Value* numbers = nullptr;  // in the model's file, if they are not the places
    if (notes.Has("groundglass_numbers") && notes.Get("groundglass_numbers").IsArray() &&
        notes.Get("groundglass_numbers").ArrayLen() == faces.ArrayLen()) {
      numbers = &notes.Get("groundglass_numbers");
    }
    size_t sum = 0;
    for (size_t i = 0; i < faces.ArrayLen(); ++i) {
      const int count = corners.Get(i).GetNumberAsInt();
      if (count < 3 || !names.Get(i).IsString()) return false;
      sum += static_cast<size_t>(count);
      if (sum > num_vertices) return false;
    }
    if (sum != num_vertices) return false;
    int next = 0;
    for (size_t i = 0; i < faces.ArrayLen(); ++i) {
      std::vector<int> polygon(static_cast<size_t>(corners.Get(i).GetNumberAsInt()));
      for (int& corner : polygon) corner = next++;
      append_face(polygon, names.Get(i).Get<std::string>());
      const int place = faces.Get(i).GetNumberAsInt();
      own_order_.push_back(place);
      const bool has_number = numbers != nullptr && numbers->Get(i).GetNumberAsInt() > 0;
      result_.model.faces.back().number =
          has_number ? numbers->Get(i).GetNumberAsInt() : std::max(place, 0) + 1;
    }
    return true;
  }

  // The image of a material's base colour; -1 for none.
  int TextureImage(int material) {
    if (material < 0) return -1;
    const int index =
        At(gltf_.materials, material, "material").pbrMetallicRoughness.baseColorTexture.index;
    if (index < 0) return -1;
    return FindTextureImage(At(gltf_.textures, index, "texture"), unread_textures_);
  }

  void TellUnreadTextures() {
    for (const std::string& name : unread_textures_) {
      reading_.warnings.push_back(
          Error(file_,
                "pictures of the kind " + Quote(name) + " are not read; their faces are grey")
              .what());
    }
  }

  // Our faces were parted by page; put them back in the model's order.
  void RestoreOrder() {
    std::vector<size_t> order(result_.faces.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      return own_order_[a] < own_order_[b];
    });
    std::vector<Face> faces;
    std::vector<FaceTexture> textures;
    for (const size_t i : order) {
      faces.push_back(std::move(result_.model.faces[i]));
      textures.push_back(std::move(result_.faces[i]));
    }
    result_.model.faces = std::move(faces);
    result_.faces = std::move(textures);
  }

  std::filesystem::path file_;
  std::optional<LengthUnit> unit_;
  tinygltf::Model gltf_;
  MeshReading reading_;
  TexturedModel& result_ = reading_.textured;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();  // CESIUM_RTC
  std::set<std::string> unread_textures_;
  std::vector<int> own_order_;  // of each face in the model it was written from; -1 unknown
};

}  // namespace

MeshReading ReadGltf(const std::filesystem::path& file,
                     std::optional<LengthUnit> unit,
                     bool with_pages) {
  return GltfReader(file, unit).Read(with_pages);
}

}  // namespace groundglass
