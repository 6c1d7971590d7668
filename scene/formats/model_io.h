// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/osu_io.h"
#include "scene/polygon_model.h"
#include "scene/textured_model.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What a file's axes mean.
enum class MeshAxes {
  kWorld,  // x east, y north, z up: taken as it is
  kSite,   // x east, y south, z up, left-handed as in .osu
  kYUp,    // x east, y up, z south (glTF): world = (x, -z, y)
  kZUp,    // z up, and y as the format has it: `site` in .osu, else `world`
};

// What a person knows of a model better than its file.
struct ModelOptions {
  // In place of the format's own: .osu is `site`, glTF has y up, the others are `world`.
  std::optional<MeshAxes> mesh_axes;
  std::optional<LengthUnit> unit;  // in place of the file's; glTF, always in metres, is converted
  std::optional<double> sigma;     // in place of the file's; the model's unit
  bool flip_faces = false;         // the fronts of faces are on their other side
};

// The axes that a file is read with, never kZUp.
MeshAxes AxesOf(const std::filesystem::path& file, const ModelOptions& options);
// point in `world` = WorldFromAxes(axes) * point in the file
Eigen::Matrix3d WorldFromAxes(MeshAxes axes);
// What the options say beyond the file, but for its unit: `model` as it was read without them.
void ApplyModelOptions(const std::filesystem::path& file,
                       const ModelOptions& options,
                       PolygonModel& model);

// Reads any model format by its extension: .osu, .obj, .ply, .stl, .gltf, .glb. Polygons stay
// polygons where the format has them. Throws Error.
ModelReading ReadModel(const std::filesystem::path& file, const ModelOptions& options = {});

// A model with its pages, and what was odd about it.
struct TexturedModelReading {
  TexturedModel textured;  // `faces`: one for each of the model's
  std::vector<std::string> warnings;
  std::vector<int> left_out = {};  // the numbers of its file's faces that it does not have
};

// Reads any model as ReadModel does, with its textures if it is .glb, .gltf or .obj. Without
// `with_pages` pictures are not opened.
TexturedModelReading ReadTexturedModel(const std::filesystem::path& file,
                                       const ModelOptions& options = {},
                                       bool with_pages = true);

// OBJ without textures, in `world`, the model's unit; face names as groups.
std::string FormatObj(const PolygonModel& model);

}  // namespace groundglass
