// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/model_io.h"
#include "scene/textured_model.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// Mesh files from other programs, and what they need before they are a polygon model.

// PLY or STL, polygons kept, in the file's own coordinates; identical points are joined.
// Faces are not yet checked. Throws Error.
PolygonModel ReadPlainMesh(const std::filesystem::path& file);

// glTF or GLB in `world`. Lengths are metres in the file; they come in `unit` if it is given, else
// in the unit that a file of ours names, else in metres. Triangles stay triangles, but a file of
// ours gives its polygons back. Pictures are decoded only if `with_pages`. Faces are not yet
// checked. Throws Error.
TexturedModel ReadGltf(const std::filesystem::path& file,
                       std::optional<LengthUnit> unit,
                       bool with_pages);

// Points at exactly the same place become one.
void JoinIdenticalPoints(PolygonModel& model);

// Which of the model's faces can be used; a modelling program's slivers and doubles hold no
// picture. One warning tells how many are unusable and why the first is; others name faces that
// are out of plane. `lines`: where each face stands in the file, if it has lines.
std::vector<int> FindUsableFaces(const PolygonModel& model,
                                 const std::filesystem::path& file,
                                 const std::vector<int>& lines,
                                 std::vector<std::string>& warnings);
// The same model with these faces only.
void KeepFaces(PolygonModel& model, const std::vector<int>& faces);

}  // namespace groundglass
