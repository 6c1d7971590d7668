// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/osu_io.h"
#include "scene/polygon_model.h"

#include <filesystem>

namespace groundglass {

// How a right-handed mesh file's axes map to `world`.
enum class MeshAxes {
  kWorld,  // x east, y north, z up: taken as it is
  kSite,   // x east, y south, z up, left-handed as in .osu
  kYUp,    // x east, y up, z south (glTF): world = (x, -z, y)
};

struct ModelOptions {
  MeshAxes mesh_axes = MeshAxes::kWorld;  // for OBJ, PLY, STL; glTF is always y up, in metres
  std::optional<LengthUnit> unit;         // overrides what the file says
};

// Reads any model format by its extension: .osu, .obj, .ply, .stl, .gltf, .glb. Polygons stay
// polygons where the format has them. Throws Error.
ModelReading ReadModel(const std::filesystem::path& file, const ModelOptions& options = {});

// OBJ without textures, in `world`, the model's unit; face names as groups.
std::string FormatObj(const PolygonModel& model);

// Faults of a face that make it unusable, and oddities worth a warning; shared by all readers.
struct FaceCheck {
  std::string fault;    // empty if usable
  std::string warning;  // empty if planar within 0.1 % of its size
};
FaceCheck CheckFace(const PolygonModel& model, int face);

}  // namespace groundglass
