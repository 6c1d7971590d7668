// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What our files call the grey of faces that no photograph shows: a mark, and no colour.
inline constexpr const char* kNoPhotographMaterial = "no_photograph";

// What a material of an OBJ file's library shows.
struct ObjMaterial {
  std::string picture;           // as written; empty if it has none
  std::filesystem::path folder;  // of the library
  // Its colour (`Kd`), linear light. The format does not say what the numbers are: they are taken
  // as sRGB, which is what most programs write that have a person choose a colour.
  std::optional<std::array<float, 3>> colour;
  // Texture points are scaled, then moved (`-s` and `-o`).
  Eigen::Vector2d scale = Eigen::Vector2d::Ones();
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
};

// The materials of the libraries that the OBJ file names, by their names; what is missing is a
// warning.
std::map<std::string, ObjMaterial> ReadMaterials(const std::filesystem::path& obj_file,
                                                 const std::vector<std::string>& libraries,
                                                 std::vector<std::string>& warnings);

// A file that another one names, as exporters on other systems do: with backslashes, in another
// case, or with a folder that exists on their machine only (the name alone is then sought beside
// the file). Nothing if there is none.
std::optional<std::filesystem::path> FindNamedFile(const std::filesystem::path& folder,
                                                   const std::string& name);

}  // namespace groundglass
