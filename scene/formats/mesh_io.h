// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/textured_model.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// A mesh file as it is written, before anything is decided about its axes or its single faces,
// which have their numbers in the file. Each reader throws Error naming the file, and the line
// where there is one; any damage gives an Error or a model.
//
// OBJ, PLY and STL are read by our own code. Libraries for them (Assimp, tinyobjloader) hold
// coordinates as floats unless they are built otherwise, which loses centimetres of a surveyed
// coordinate, and tell neither the line of a face nor the comments in which a model says its unit
// and sigma.
struct MeshReading {
  TexturedModel textured;       // faces: empty if the format has no textures
  std::vector<int> face_lines;  // empty if the file has no lines
  std::vector<std::string> warnings;
  std::vector<int> left_out = {};  // the numbers of faces with a corner that is no point
};

enum class MeshPages {
  kNone,
  kPictures,            // one that is missing or damaged is a warning, and its faces are grey
  kPicturesAndColours,  // plain colours of materials on a page too (coloured_model_io.h)
};
// PLY or STL: polygons kept, coordinates as precise as the file has them; identical points are
// joined. Pictures and colours of a PLY are not read: a warning where pages are wanted.
MeshReading ReadPly(const std::filesystem::path& file, MeshPages pages);
MeshReading ReadStl(const std::filesystem::path& file);
MeshReading ReadTexturedObj(const std::filesystem::path& file, MeshPages pages);

// glTF or GLB in `world`. Lengths are metres in the file; they come in `unit` if it is given, else
// in the unit that a file of ours names, else in metres. Triangles stay triangles, but a file of
// ours gives its polygons back.
MeshReading ReadGltf(const std::filesystem::path& file,
                     std::optional<LengthUnit> unit,
                     MeshPages pages);

// A coordinate that a mesh has as nan or inf, which programs write for a point that they could not
// compute: infinite, and MendFaces leaves out the faces that have it. Throws nothing.
double OrNoPlace(double coordinate);

// Points at exactly the same place become one.
void JoinIdenticalPoints(PolygonModel& model);

}  // namespace groundglass
