// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/textured_model_io.h"

#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/formats/material_library.h"
#include "scene/formats/obj_io.h"
#include "scene/text.h"

#include <tbb/parallel_for.h>

namespace groundglass {
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
      WriteFileAtomically(file.parent_path() / picture, AsText(pages[i]));
    } else {
      WriteSrgb8(file.parent_path() / picture, model.pages[i].srgb8);
    }
    materials += "\nnewmtl page_" + std::to_string(i) + "\nKa 1 1 1\nKd 1 1 1\nillum 0\nmap_Kd " +
                 picture + "\n";
  }
  materials += std::string("\nnewmtl ") + kNoPhotographMaterial + "\nKd 0.5 0.5 0.5\nillum 1\n";
  std::filesystem::path library = file;
  library.replace_extension(".mtl");
  WriteFileAtomically(library, materials);

  std::string text = "# Groundglass: x east, y north, z up.\n" + ObjModelComments(model.model) +
                     "mtllib " + library.filename().string() + "\n";
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
        texture.page >= 0 ? "page_" + std::to_string(texture.page) : kNoPhotographMaterial;
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

}  // namespace groundglass
