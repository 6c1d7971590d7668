// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "scene/frames.h"
#include "scene/image_io.h"
#include "scene/mesh_io.h"
#include "scene/own_tiny_gltf.h"
#include "scene/text.h"
#include "scene/view_io.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace groundglass {
namespace {

// Keeps a picture's bytes as they are: they are decoded only if somebody asks.
bool KeepImageBytes(tinygltf::Image* image,
                    const int,
                    std::string*,
                    std::string*,
                    int,
                    int,
                    const unsigned char* bytes,
                    int size,
                    void*) {
  image->as_is = true;
  image->image.assign(bytes, bytes + std::max(0, size));
  return true;
}

// glTF is y up with z towards the viewer; `world` is z up.
Eigen::Vector3d WorldFromGltf(const Eigen::Vector3d& point) {
  return {point.x(), -point.z(), point.y()};
}

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& file, std::optional<LengthUnit> unit)
      : file_(file), unit_(unit) {}

  TexturedModel Read(bool with_pages) {
    Parse();
    ReadOwnNotes();
    const int scene_index = gltf_.defaultScene >= 0 ? gltf_.defaultScene : 0;
    if (gltf_.scenes.empty()) {
      Fail("it has no scene");
    }
    for (const int node : At(gltf_.scenes, scene_index, "scene").nodes) {
      AppendNode(node, Eigen::Matrix4d::Identity(), 0);
    }
    RestoreOrder();
    FindPages(with_pages);
    JoinIdenticalPoints(result_.model);
    return std::move(result_);
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    throw Error(file_, "cannot read this glTF model: " + message);
  }

  template <typename T>
  const T& At(const std::vector<T>& items, int index, const char* what) const {
    if (index < 0 || static_cast<size_t>(index) >= items.size()) {
      Fail(std::string("it names a ") + what + " that it does not have");
    }
    return items[static_cast<size_t>(index)];
  }

  void Parse() {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file_, error)) throw Error(file_, "no such model file");
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(KeepImageBytes, nullptr);
    std::string faults;
    std::string warnings;
    bool is_read = false;
    try {
      is_read = LowerCase(file_.extension().string()) == ".glb"
                    ? parser.LoadBinaryFromFile(&gltf_, &faults, &warnings, file_.string())
                    : parser.LoadASCIIFromFile(&gltf_, &faults, &warnings, file_.string());
    } catch (const std::exception& exception) {
      Fail(exception.what());
    }
    if (!is_read) {
      std::replace(faults.begin(), faults.end(), '\n', ' ');
      Fail(faults.empty() ? "it is damaged" : faults);
    }
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

  // An accessor's numbers, `width` to an element; whole numbers are scaled if they are marked so.
  std::vector<double> ReadAccessor(int index, int width) const {
    const tinygltf::Accessor& accessor = At(gltf_.accessors, index, "accessor");
    if (accessor.sparse.isSparse) Fail("sparse accessors are not supported");
    const tinygltf::BufferView& view = At(gltf_.bufferViews, accessor.bufferView, "buffer view");
    const tinygltf::Buffer& buffer = At(gltf_.buffers, view.buffer, "buffer");
    const int component_size =
        tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType));
    const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
    if (component_size < 1 || components != width) Fail("an accessor has the wrong type");
    const size_t element = static_cast<size_t>(component_size) * static_cast<size_t>(components);
    const size_t stride = view.byteStride > 0 ? view.byteStride : element;
    const size_t begin = view.byteOffset + accessor.byteOffset;
    const size_t available = buffer.data.size();
    if (begin > available || stride < element ||
        (accessor.count > 0 && (accessor.count - 1 > (available - begin) / stride ||
                                begin + (accessor.count - 1) * stride + element > available))) {
      Fail("an accessor reaches beyond its buffer");
    }
    std::vector<double> values;
    values.reserve(accessor.count * static_cast<size_t>(width));
    for (size_t i = 0; i < accessor.count; ++i) {
      const unsigned char* at = buffer.data.data() + begin + i * stride;
      for (int c = 0; c < components; ++c) {
        values.push_back(ReadComponent(at + c * component_size, accessor));
      }
    }
    return values;
  }

  double ReadComponent(const unsigned char* at, const tinygltf::Accessor& accessor) const {
    const auto read = [at](auto value) {
      std::memcpy(&value, at, sizeof(value));
      return static_cast<double>(value);
    };
    const double scale = accessor.normalized ? 1.0 : 0.0;
    switch (accessor.componentType) {
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return read(float{});
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return read(uint8_t{}) / (scale > 0 ? 255 : 1);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return read(uint16_t{}) / (scale > 0 ? 65535 : 1);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return read(uint32_t{});
      default:
        Fail("an accessor has a type that is not supported");
    }
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
        triangles.push_back({corners[i], corners[i + 1 + odd], corners[i + 2 - odd]});
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
    const std::vector<double> coordinates = ReadAccessor(position->second, 3);
    const size_t num_vertices = coordinates.size() / 3;
    PolygonModel& model = result_.model;
    const int first = static_cast<int>(model.points_in_world.size());
    const double units_per_metre = 1 / MetresPerUnit(model.unit);
    for (size_t i = 0; i < num_vertices; ++i) {
      const Eigen::Vector4d point(
          coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2], 1);
      const Eigen::Vector3d placed = (transform * point).head<3>();
      if (!placed.allFinite()) Fail("a point's coordinates are not finite numbers");
      model.points_in_world.push_back(units_per_metre * WorldFromGltf(placed));
    }

    std::vector<double> uv;
    const int texture = TextureImage(primitive.material);
    const auto texcoord = primitive.attributes.find("TEXCOORD_0");
    if (texture >= 0 && texcoord != primitive.attributes.end()) {
      uv = ReadAccessor(texcoord->second, 2);
      if (uv.size() / 2 != num_vertices) Fail("texture coordinates do not match its points");
    }
    const auto append_face = [&](const std::vector<int>& corners, const std::string& name) {
      Face face;
      face.name = name;
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
      own_order_.push_back(faces.Get(i).GetNumberAsInt());
    }
    return true;
  }

  // The image of a material's base colour; -1 for none.
  int TextureImage(int material) const {
    if (material < 0) return -1;
    const int texture =
        At(gltf_.materials, material, "material").pbrMetallicRoughness.baseColorTexture.index;
    if (texture < 0) return -1;
    return At(gltf_.textures, texture, "texture").source;
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

  // Decodes the images that faces use, in order, and turns shares of the picture into texels.
  void FindPages(bool with_pages) {
    std::vector<int> page_of_image(gltf_.images.size(), -1);
    for (FaceTexture& face : result_.faces) {
      if (face.page < 0) continue;
      if (!with_pages) {
        face = FaceTexture();
        continue;
      }
      const tinygltf::Image& image = At(gltf_.images, face.page, "image");
      int& page = page_of_image[static_cast<size_t>(face.page)];
      if (page < 0) {
        page = static_cast<int>(result_.pages.size());
        result_.pages.emplace_back().srgb8 = Decode(image);
      }
      face.page = page;
      const Image8& picture = result_.pages[static_cast<size_t>(page)].srgb8;
      for (Eigen::Vector2d& corner : face.corners_texel) {
        corner = {corner.x() * picture.width, corner.y() * picture.height};
      }
    }
  }

  Image8 Decode(const tinygltf::Image& image) const {
    const std::vector<unsigned char>& bytes = image.image;
    const bool is_png = bytes.size() > 4 && bytes[1] == 'P' && bytes[2] == 'N';
    try {
      return DecodeSrgb8(bytes, is_png ? ".png" : ".jpg");
    } catch (const Error& error) {
      Fail("a texture cannot be read: " + std::string(error.what()));
    }
  }

  std::filesystem::path file_;
  std::optional<LengthUnit> unit_;
  tinygltf::Model gltf_;
  TexturedModel result_;
  std::vector<int> own_order_;  // of each face in the model it was written from; -1 unknown
};

}  // namespace

TexturedModel ReadGltf(const std::filesystem::path& file,
                       std::optional<LengthUnit> unit,
                       bool with_pages) {
  return GltfReader(file, unit).Read(with_pages);
}

}  // namespace groundglass
