// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/colour_page.h"
#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/material_library.h"
#include "scene/formats/mesh_io.h"
#include "scene/formats/obj_io.h"
#include "scene/text.h"

#include <map>

namespace groundglass {
namespace {

std::string GreyFaces(int count) {
  return count == 1 ? "its face is grey" : "its " + std::to_string(count) + " faces are grey";
}

// Lays the faces on the pictures of their materials.
class ObjTexturer {
 public:
  ObjTexturer(const std::filesystem::path& file, const ObjReading& obj, MeshReading& reading)
      : file_(file),
        obj_(obj),
        reading_(reading),
        materials_(ReadMaterials(file, obj.libraries, reading.warnings)) {}

  void Texture() {
    for (size_t i = 0; i < obj_.materials.size(); ++i) {
      FaceTexture& face = reading_.textured.faces[i];
      const std::string& name = obj_.materials[i];
      if (name.empty()) continue;
      const auto material = materials_.find(name);
      if (material == materials_.end()) {
        ++num_without_material_[name];
        continue;
      }
      if (material->second.picture.empty() || obj_.face_texture_points[i].empty()) continue;
      const int page = PageOf(material->second);
      if (page < 0) continue;
      face.page = page;
      const Image8& srgb8 = reading_.textured.pages[static_cast<size_t>(page)].srgb8;
      for (const int point : obj_.face_texture_points[i]) {
        const Eigen::Vector2d uv =
            obj_.texture_points[static_cast<size_t>(point)].cwiseProduct(material->second.scale) +
            material->second.offset;
        // OBJ counts v upwards from the picture's bottom edge.
        face.corners_texel.emplace_back(uv.x() * srgb8.width, (1 - uv.y()) * srgb8.height);
      }
    }
    Tell();
  }

  // Faces without a picture get their material's colour; after Texture.
  void Colour() {
    const int page = static_cast<int>(reading_.textured.pages.size());
    ColourPage colours;
    for (size_t i = 0; i < obj_.materials.size(); ++i) {
      FaceTexture& face = reading_.textured.faces[i];
      const auto material = materials_.find(obj_.materials[i]);
      // One that is to have a picture stays grey without it.
      if (face.page >= 0 || material == materials_.end() || !material->second.picture.empty() ||
          !material->second.colour) {
        continue;
      }
      face = colours.Add(
          *material->second.colour, page, reading_.textured.model.faces[i].points.size());
    }
    if (!colours.IsEmpty()) reading_.textured.pages.push_back(colours.Page());
  }

 private:
  // -1 if there is no such picture, or it cannot be read.
  int PageOf(const ObjMaterial& material) {
    const auto [known, is_new] = page_of_picture_.try_emplace({material.folder, material.picture});
    Picture& picture = known->second;
    ++picture.num_faces;
    if (!is_new) return picture.page;
    const auto found = FindNamedFile(material.folder, material.picture);
    if (!found) {
      picture.fault =
          Error(file_, "the picture " + Quote(material.picture) + " is not there").what();
      return -1;
    }
    try {
      Image8 srgb8 = ReadSrgb8(*found);
      picture.page = static_cast<int>(reading_.textured.pages.size());
      reading_.textured.pages.emplace_back().srgb8 = std::move(srgb8);
    } catch (const Error& error) {
      picture.fault = error.what();
    }
    return picture.page;
  }

  void Tell() {
    for (const auto& [name, picture] : page_of_picture_) {
      if (picture.page >= 0) continue;
      reading_.warnings.push_back(picture.fault + "; " + GreyFaces(picture.num_faces));
    }
    if (materials_.empty()) return;  // the libraries are missing, which is told already
    for (const auto& [name, count] : num_without_material_) {
      reading_.warnings.push_back(
          Error(file_, "no library has the material " + Quote(name) + "; " + GreyFaces(count))
              .what());
    }
  }

  struct Picture {
    int page = -1;
    int num_faces = 0;
    std::string fault;
  };
  const std::filesystem::path& file_;
  const ObjReading& obj_;
  MeshReading& reading_;
  std::map<std::string, ObjMaterial> materials_;
  std::map<std::pair<std::filesystem::path, std::string>, Picture> page_of_picture_;
  std::map<std::string, int> num_without_material_;
};

}  // namespace

MeshReading ReadTexturedObj(const std::filesystem::path& file, MeshPages pages) {
  ObjReading obj = ReadObj(file);
  MeshReading reading;
  reading.textured.model = std::move(obj.model);
  reading.face_lines = std::move(obj.face_lines);
  reading.left_out = std::move(obj.left_out);
  reading.warnings = std::move(obj.warnings);
  reading.textured.faces.resize(reading.textured.model.faces.size());
  if (pages == MeshPages::kNone) return reading;
  ObjTexturer texturer(file, obj, reading);
  texturer.Texture();
  if (pages == MeshPages::kPicturesAndColours) texturer.Colour();
  return reading;
}

}  // namespace groundglass
