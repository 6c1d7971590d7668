// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"

#include <Eigen/Dense>

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// An OBJ file as it is written, before anything is decided about its axes. `model` holds the
// file's own coordinates; names come from `g` and `o` and run to the end of the line, `#` and
// blanks included. Lines that end in a backslash go on in the next.
struct ObjReading {
  PolygonModel model;
  std::vector<int> face_lines;                        // for messages
  std::vector<std::string> libraries;                 // `mtllib`
  std::vector<std::string> materials;                 // `usemtl` of each face; may be empty
  std::vector<Eigen::Vector2d> texture_points;        // `vt`, v upwards from the picture's bottom
  std::vector<std::vector<int>> face_texture_points;  // of each face's corners; empty: none
  std::vector<std::string> warnings;                  // of faces that are left out
  std::vector<int> left_out = {};                     // their numbers
};

// Throws Error naming file and line. A face with a corner that is no point is left out with a
// warning, and the others keep their numbers, unless most are such. Geometry of the faces is not
// yet checked.
ObjReading ReadObj(const std::filesystem::path& file);

// A face's name as a group's: on one line; "default" for none.
std::string ObjGroupName(std::string name);

// The comments above a model's points that give back its unit and its faces' numbers.
std::string ObjModelComments(const PolygonModel& model);

}  // namespace groundglass
