// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/textured_model_io.h"

#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/mesh_io.h"
#include "scene/obj_io.h"
#include "scene/text.h"
#include "scene/view_io.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>

namespace groundglass {
namespace {

// The picture of each material in a material library.
std::map<std::string, std::filesystem::path> ReadMaterialPictures(
    const std::filesystem::path& library) {
  std::map<std::string, std::filesystem::path> pictures;
  const std::string text = ReadTextFile(library);
  std::string material;
  for (const TextLine& line : SplitLines(text, '#')) {
    if (line.tokens.size() < 2) continue;
    const std::string keyword = LowerCase(line.tokens[0].text);
    // The rest of the line, for names with blanks; after options only the last word is the file.
    const std::string_view last = line.tokens.back().text;
    const char* begin =
        line.tokens[1].text.front() == '-' ? last.data() : line.tokens[1].text.data();
    std::string rest(begin, static_cast<size_t>(last.data() + last.size() - begin));
    if (keyword == "newmtl") {
      material = rest;
    } else if (keyword == "map_kd") {
      std::replace(rest.begin(), rest.end(), '\\', '/');
      pictures[material] = library.parent_path() / rest;
    }
  }
  return pictures;
}

TexturedModel ReadTexturedObj(const std::filesystem::path& file) {
  ObjReading obj = ReadObj(file);
  TexturedModel textured;
  textured.model = std::move(obj.model);
  if (obj.unit) textured.model.unit = *obj.unit;
  std::map<std::string, std::filesystem::path> pictures;
  for (const std::string& library : obj.libraries) {
    pictures.merge(ReadMaterialPictures(file.parent_path() / library));
  }
  std::map<std::filesystem::path, int> page_of_picture;
  for (size_t i = 0; i < textured.model.faces.size(); ++i) {
    FaceTexture& face = textured.faces.emplace_back();
    const auto picture = pictures.find(obj.materials[i]);
    if (picture == pictures.end() || obj.face_texture_points[i].empty()) continue;
    const auto [page, is_new] =
        page_of_picture.emplace(picture->second, static_cast<int>(textured.pages.size()));
    if (is_new) textured.pages.emplace_back().srgb8 = ReadSrgb8(picture->second);
    face.page = page->second;
    const Image8& srgb8 = textured.pages[static_cast<size_t>(face.page)].srgb8;
    for (const int point : obj.face_texture_points[i]) {
      const Eigen::Vector2d& uv = obj.texture_points[static_cast<size_t>(point)];
      // OBJ counts v upwards from the picture's bottom edge.
      face.corners_texel.emplace_back(uv.x() * srgb8.width, (1 - uv.y()) * srgb8.height);
    }
  }
  return textured;
}

}  // namespace

JpegPages EncodePages(const TexturedModel& model) {
  JpegPages pages(model.pages.size());
  tbb::parallel_for(size_t{0}, pages.size(), [&](size_t i) {
    pages[i] = EncodeImage(model.pages[i].srgb8, ".jpg");
  });
  return pages;
}

void WriteTexturedObj(const std::filesystem::path& file,
                      const TexturedModel& model,
                      const std::string& image_extension,
                      const JpegPages& pages) {
  const std::string stem = file.stem().string();
  std::string materials = "# Groundglass: one material for each texture page.\n";
  for (size_t i = 0; i < model.pages.size(); ++i) {
    const std::string picture = stem + "_" + std::to_string(i) + image_extension;
    const bool has_16_bits = !model.pages[i].srgb16.Empty() && image_extension != ".jpg";
    if (has_16_bits) {
      WriteSrgb16(file.parent_path() / picture, model.pages[i].srgb16);
    } else if (image_extension == ".jpg" && i < pages.size()) {
      WriteFileAtomically(file.parent_path() / picture,
                          std::string(pages[i].begin(), pages[i].end()));
    } else {
      WriteSrgb8(file.parent_path() / picture, model.pages[i].srgb8);
    }
    materials += "\nnewmtl page_" + std::to_string(i) + "\nKa 1 1 1\nKd 1 1 1\nillum 0\nmap_Kd " +
                 picture + "\n";
  }
  materials += "\nnewmtl no_photograph\nKd 0.5 0.5 0.5\nillum 1\n";
  std::filesystem::path library = file;
  library.replace_extension(".mtl");
  WriteFileAtomically(library, materials);

  std::string text = std::string("# Groundglass: x east, y north, z up.\n# unit: ") +
                     UnitName(model.model.unit) + "\nmtllib " +
                     library.filename().string() + "\n";
  for (const Eigen::Vector3d& point : model.model.points_in_world) {
    text += "v " + FormatNumber(point.x() + 0.0) + " " + FormatNumber(point.y() + 0.0) + " " +
            FormatNumber(point.z() + 0.0) + "\n";
  }
  size_t num_texture_points = 0;
  std::string group;
  std::string material;
  for (size_t i = 0; i < model.model.faces.size(); ++i) {
    const Face& face = model.model.faces[i];
    const FaceTexture& texture = model.faces[i];
    if (face.name != group) {
      group = face.name;
      text += "g " + ObjGroupName(group) + "\n";
    }
    const std::string face_material =
        texture.page >= 0 ? "page_" + std::to_string(texture.page) : "no_photograph";
    if (face_material != material) {
      material = face_material;
      text += "usemtl " + material + "\n";
    }
    if (texture.page >= 0) {
      const Image8& srgb8 = model.pages[static_cast<size_t>(texture.page)].srgb8;
      for (const Eigen::Vector2d& texel : texture.corners_texel) {
        text += "vt " + FormatNumber(texel.x() / srgb8.width) + " " +
                FormatNumber(1 - texel.y() / srgb8.height) + "\n";
      }
    }
    text += "f";
    for (const int point : face.points) {
      text += " " + std::to_string(point + 1);
      if (texture.page >= 0) text += "/" + std::to_string(++num_texture_points);
    }
    text += "\n";
  }
  WriteFileAtomically(file, text);
}

TexturedModel ReadTexturedModel(const std::filesystem::path& file, const ModelOptions& options) {
  const std::string extension = LowerCase(file.extension().string());
  TexturedModel textured;
  if (extension == ".glb" || extension == ".gltf") {
    textured = ReadGltf(file, options.unit, true);
  } else if (extension == ".obj") {
    textured = ReadTexturedObj(file);
    if (options.unit) textured.model.unit = *options.unit;
  } else {
    textured.model = ReadModel(file, options).model;
    textured.faces.resize(textured.model.faces.size());
    return textured;
  }
  std::vector<std::string> warnings;
  const std::vector<int> usable = FindUsableFaces(textured.model, file, {}, warnings);
  if (usable.empty()) throw Error(file, "this model has no usable face");
  KeepFaces(textured.model, usable);
  std::vector<FaceTexture> faces;
  for (const int face : usable)
    faces.push_back(std::move(textured.faces[static_cast<size_t>(face)]));
  textured.faces = std::move(faces);
  ApplyModelOptions(file, options, textured.model);
  if (options.flip_faces) {
    for (FaceTexture& face : textured.faces) {
      std::reverse(face.corners_texel.begin(), face.corners_texel.end());
    }
  }
  return textured;
}

}  // namespace groundglass
