// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/model_io.h"

#include "scene/error.h"
#include "scene/frames.h"
#include "scene/mesh_io.h"
#include "scene/obj_io.h"
#include "scene/text.h"

#include <string>

namespace groundglass {
namespace {

Eigen::Vector3d WorldFromMesh(const Eigen::Vector3d& point, MeshAxes axes) {
  switch (axes) {
    case MeshAxes::kWorld:
      return point;
    case MeshAxes::kSite:
      return WorldFromSite(point);
    case MeshAxes::kYUp:
      return {point.x(), -point.z(), point.y()};
  }
  return point;
}

}  // namespace

ModelReading ReadModel(const std::filesystem::path& file, const ModelOptions& options) {
  const std::string extension = LowerCase(file.extension().string());
  if (extension == ".osu") {
    ModelReading reading = ReadOsu(file);
    if (options.unit) reading.model.unit = *options.unit;
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
      lines = std::move(obj.face_lines);
    } else {
      model = ReadPlainMesh(file);
    }
    for (Eigen::Vector3d& point : model.points_in_world) {
      point = WorldFromMesh(point, options.mesh_axes);
    }
    if (options.unit) model.unit = *options.unit;
  } else {
    throw Error(file, "this kind of model is not read; expected .osu, .obj, .ply, .stl or .glb");
  }
  const std::vector<int> usable = FindUsableFaces(model, file, lines, reading.warnings);
  if (usable.empty()) {
    throw Error(reading.warnings.empty() ? Error(file, "this model has no faces").what()
                                         : reading.warnings.back());
  }
  KeepFaces(model, usable);
  return reading;
}

std::string FormatObj(const PolygonModel& model) {
  std::string text = std::string("# Polygon model; x east, y north, z up.\n# unit: ") +
                     UnitName(model.unit) + "\n";
  if (model.sigma) text += "# sigma: " + FormatNumber(*model.sigma) + "\n";
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
