// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/model_io.h"

#include "scene/error.h"
#include "scene/frames.h"
#include "scene/obj_io.h"
#include "scene/text.h"

#include <algorithm>
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

ModelReading ReadPlainObj(const std::filesystem::path& file, const ModelOptions& options) {
  ObjReading obj = ReadObj(file);
  ModelReading reading;
  reading.model = std::move(obj.model);
  if (obj.unit) reading.model.unit = *obj.unit;
  for (Eigen::Vector3d& point : reading.model.points_in_world) {
    point = WorldFromMesh(point, options.mesh_axes);
  }
  // A modelling program's slivers hold no picture, so they are left out, each with a warning.
  std::vector<Face> usable;
  for (size_t i = 0; i < reading.model.faces.size(); ++i) {
    const FaceCheck check = CheckFace(reading.model, static_cast<int>(i));
    const std::string about = DescribeFace(reading.model, static_cast<int>(i)) + " ";
    if (!check.fault.empty()) {
      reading.warnings.push_back(
          Error(file, obj.face_lines[i], about + check.fault + "; left out").what());
      continue;
    }
    if (!check.warning.empty()) {
      reading.warnings.push_back(Error(file, obj.face_lines[i], about + check.warning).what());
    }
    usable.push_back(std::move(reading.model.faces[i]));
  }
  reading.model.faces = std::move(usable);
  return reading;
}

}  // namespace

ModelReading ReadModel(const std::filesystem::path& file, const ModelOptions& options) {
  const std::string extension = LowerCase(file.extension().string());
  ModelReading reading;
  if (extension == ".osu") {
    reading = ReadOsu(file);
  } else if (extension == ".obj") {
    reading = ReadPlainObj(file, options);
  } else {
    throw Error(file, "this kind of model is not read; expected .osu, .obj, .ply, .stl or .glb");
  }
  if (reading.model.faces.empty()) throw Error(file, "this model has no usable face");
  if (options.unit) reading.model.unit = *options.unit;
  return reading;
}

std::string FormatObj(const PolygonModel& model) {
  std::string text = std::string("# Polygon model; x east, y north, z up.\n# unit: ") +
                     (model.unit == LengthUnit::kMetre ? "m" : "ft") + "\n";
  for (const Eigen::Vector3d& point : model.points_in_world) {
    text += "v " + FormatNumber(point.x() + 0.0) + " " + FormatNumber(point.y() + 0.0) + " " +
            FormatNumber(point.z() + 0.0) + "\n";
  }
  std::string group;
  for (const Face& face : model.faces) {
    if (face.name != group) {
      group = face.name;
      std::string word = group.empty() ? "default" : group;
      std::replace(word.begin(), word.end(), '\n', ' ');
      text += "g " + word + "\n";
    }
    text += "f";
    for (const int point : face.points) text += " " + std::to_string(point + 1);
    text += "\n";
  }
  return text;
}

}  // namespace groundglass
