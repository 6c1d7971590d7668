// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/model_io.h"

#include "scene/error.h"
#include "scene/frames.h"
#include "scene/mesh_io.h"
#include "scene/obj_io.h"
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

ModelReading ReadModel(const std::filesystem::path& file, const ModelOptions& options) {
  const std::string extension = LowerCase(file.extension().string());
  if (extension == ".osu") {
    ModelReading reading = ReadOsu(file);
    SetUnit(options, reading.model);
    ApplyModelOptions(file, options, reading.model);
    return reading;
  }
  ModelReading reading;
  PolygonModel& model = reading.model;
  std::vector<int> lines;
  if (extension == ".glb" || extension == ".gltf") {
    model = ReadGltf(file, options.unit, false).model;
  } else if (extension == ".obj" || extension == ".ply" || extension == ".stl") {
    if (extension == ".obj") {
      ObjReading obj = ReadObj(file);
      model = std::move(obj.model);
      if (obj.unit) model.unit = *obj.unit;
      model.is_unit_assumed = !obj.unit;
      lines = std::move(obj.face_lines);
    } else {
      model = ReadPlainMesh(file);
      model.is_unit_assumed = true;
    }
    SetUnit(options, model);
  } else {
    throw Error(file, "this kind of model is not read; expected .osu, .obj, .ply, .stl or .glb");
  }
  const std::vector<int> usable = FindUsableFaces(model, file, lines, reading.warnings);
  if (usable.empty()) {
    throw Error(reading.warnings.empty() ? Error(file, "this model has no faces").what()
                                         : reading.warnings.back());
  }
  KeepFaces(model, usable);
  ApplyModelOptions(file, options, model);
  return reading;
}

std::string FormatObj(const PolygonModel& model) {
  std::string text = std::string("# Polygon model; x east, y north, z up.\n# unit: ") +
                     UnitName(model.unit) + "\n";
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
