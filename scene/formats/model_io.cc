// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/model_io.h"

#include "scene/error.h"
#include "scene/formats/coloured_model_io.h"
#include "scene/formats/mesh_io.h"
#include "scene/formats/model_kind.h"
#include "scene/formats/obj_io.h"
#include "scene/formats/text_encoding.h"
#include "scene/formats/why_no_faces.h"
#include "scene/frames.h"
#include "scene/mend_faces.h"
#include "scene/text.h"

#include <algorithm>
#include <string>

namespace groundglass {
namespace {

// The axes that a format has by itself.
MeshAxes FormatAxes(const std::string& extension) {
  if (extension == ".osu") return MeshAxes::kSite;
  return extension == ".glb" || extension == ".gltf" ? MeshAxes::kYUp : MeshAxes::kWorld;
}

void SetUnit(const ModelOptions& options, PolygonModel& model) {
  if (!options.unit) return;
  model.unit = *options.unit;
  model.is_unit_assumed = false;
}

MeshReading ReadMesh(const std::filesystem::path& file,
                     const std::string& extension,
                     const ModelOptions& options,
                     MeshPages pages) {
  const bool is_gltf = extension == ".glb" || extension == ".gltf";
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw Error(file, "no such model file");
  CheckModelKind(file);
  if (!is_gltf && extension != ".obj" && extension != ".ply" && extension != ".stl") {
    throw Error(
        file,
        "this kind of model is not read; export it as .glb, .gltf, .obj, .ply or .stl from the "
        "program that made it, or write it as .osu");
  }
  if (!std::filesystem::is_regular_file(file, error)) throw Error(file, "no such model file");
  if (std::filesystem::file_size(file, error) == 0 && !error) {
    throw Error(file,
                "this model file is empty; copy it again from where it came from, or export it "
                "once more");
  }
  if (is_gltf) return ReadGltf(file, options.unit, pages);
  if (extension == ".obj") return ReadTexturedObj(file, pages);
  return extension == ".ply" ? ReadPly(file, pages) : ReadStl(file);
}

}  // namespace

MeshAxes AxesOf(const std::filesystem::path& file, const ModelOptions& options) {
  const MeshAxes own = FormatAxes(LowerCase(file.extension().string()));
  if (!options.mesh_axes) return own;
  if (*options.mesh_axes != MeshAxes::kZUp) return *options.mesh_axes;
  return own == MeshAxes::kSite ? MeshAxes::kSite : MeshAxes::kWorld;
}

Eigen::Matrix3d WorldFromAxes(MeshAxes axes) {
  Eigen::Matrix3d world_from_file = Eigen::Matrix3d::Identity();
  if (axes == MeshAxes::kSite) world_from_file(1, 1) = -1;
  if (axes == MeshAxes::kYUp) world_from_file << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return world_from_file;
}

void ApplyModelOptions(const std::filesystem::path& file,
                       const ModelOptions& options,
                       PolygonModel& model) {
  const MeshAxes own = FormatAxes(LowerCase(file.extension().string()));
  const MeshAxes meant = AxesOf(file, options);
  if (meant != own) {
    const Eigen::Matrix3d meant_from_own = WorldFromAxes(meant) * WorldFromAxes(own).inverse();
    for (Eigen::Vector3d& point : model.points_in_world) point = meant_from_own * point;
  }
  if (options.flip_faces) {
    for (Face& face : model.faces) std::reverse(face.points.begin(), face.points.end());
  }
  if (options.sigma) model.sigma = options.sigma;
}

namespace {

// Names from an old plan or program would break every file and page that repeats them.
void NameFacesInUtf8(const std::filesystem::path& file,
                     PolygonModel& model,
                     std::vector<std::string>& warnings) {
  bool is_told = false;
  for (int i = 0; i < static_cast<int>(model.faces.size()); ++i) {
    Face& face = model.faces[static_cast<size_t>(i)];
    if (IsUtf8(face.name)) continue;
    face.name = Utf8FromBytes(face.name).text;
    if (is_told) continue;
    warnings.push_back(Error(file,
                             "names of faces are not UTF-8 and are read as Windows-1252: " +
                                 DescribeFace(model, i) +
                                 "; if letters are wrong, save the file as UTF-8")
                           .what());
    is_told = true;
  }
}

TexturedModelReading ReadAnyModel(const std::filesystem::path& file,
                                  const ModelOptions& options,
                                  MeshPages pages) {
  const std::string extension = LowerCase(file.extension().string());
  TexturedModelReading result;
  PolygonModel& model = result.textured.model;
  std::vector<FaceTexture>& textures = result.textured.faces;
  if (extension == ".osu") {
    CheckModelKind(file);
    ModelReading osu = ReadOsu(file);
    model = std::move(osu.model);
    result.warnings = std::move(osu.warnings);
    result.left_out = std::move(osu.left_out);
  } else {
    MeshReading mesh = ReadMesh(file, extension, options, pages);
    result.textured = std::move(mesh.textured);
    result.warnings = std::move(mesh.warnings);
    MendedFaces mended = MendFaces(file, mesh.face_lines, model, textures);
    WarnOfFaults(file, mesh.face_lines, mended);
    if (mended.usable.empty()) {
      throw Error(mended.faults.empty() ? Error(file, WhyNoFaces(file)).what()
                                        : mended.warnings.back());
    }
    result.warnings.insert(result.warnings.end(), mended.warnings.begin(), mended.warnings.end());
    result.left_out = KeepFaces(mended.usable, model, textures);
    result.left_out.insert(result.left_out.end(), mesh.left_out.begin(), mesh.left_out.end());
    std::sort(result.left_out.begin(), result.left_out.end());
  }
  NameFacesInUtf8(file, model, result.warnings);
  if (extension != ".glb" && extension != ".gltf") SetUnit(options, model);
  textures.resize(model.faces.size());
  ApplyModelOptions(file, options, model);
  if (options.flip_faces) {
    for (FaceTexture& texture : textures) {
      std::reverse(texture.corners_texel.begin(), texture.corners_texel.end());
    }
  }
  return result;
}

}  // namespace

TexturedModelReading ReadTexturedModel(const std::filesystem::path& file,
                                       const ModelOptions& options,
                                       bool with_pages) {
  return ReadAnyModel(file, options, with_pages ? MeshPages::kPictures : MeshPages::kNone);
}

TexturedModelReading ReadColouredModel(const std::filesystem::path& file,
                                       const ModelOptions& options) {
  return ReadAnyModel(file, options, MeshPages::kPicturesAndColours);
}

ModelReading ReadModel(const std::filesystem::path& file, const ModelOptions& options) {
  TexturedModelReading reading = ReadTexturedModel(file, options, false);
  return {
      std::move(reading.textured.model), std::move(reading.warnings), std::move(reading.left_out)};
}

std::string FormatObj(const PolygonModel& model) {
  std::string text = "# Polygon model; x east, y north, z up.\n" + ObjModelComments(model);
  for (const Eigen::Vector3d& point : model.points_in_world) {
    text += "v " + FormatNumber(point.x() + 0.0) + " " + FormatNumber(point.y() + 0.0) + " " +
            FormatNumber(point.z() + 0.0) + "\n";
  }
  std::string group;
  for (const Face& face : model.faces) {
    if (face.name != group) {
      group = face.name;
      text += "g " + ObjGroupName(group) + "\n";
    }
    text += "f";
    for (const int point : face.points) text += " " + std::to_string(point + 1);
    text += "\n";
  }
  return text;
}

}  // namespace groundglass
