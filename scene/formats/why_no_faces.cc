// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/why_no_faces.h"

#include "scene/formats/continued_lines.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

namespace groundglass {
namespace {

constexpr const char* kNoFaces = "this model has no faces";
constexpr const char* kExportFaces =
    "; export it as a mesh, with its faces, from the program that made it";
constexpr const char* kTriangulate =
    "; export it as a mesh (polygons, triangulated), or have it made one before";

std::string CountOf(size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

// "no faces, but 6 lines and 10 points"
std::string ButHolds(const std::vector<std::string>& held) {
  std::string text = kNoFaces;
  for (size_t i = 0; i < held.size(); ++i) {
    text += (i == 0 ? ", but " : i + 1 == held.size() ? " and " : ", ") + held[i];
  }
  return text;
}

// Every word that a line of an OBJ may begin with.
bool IsObjKeyword(const std::string& word) {
  static const std::set<std::string> kKnown = {
      "v",        "vt",   "vn",         "vp",        "f",      "fo",     "l",      "p",
      "g",        "o",    "s",          "mg",        "usemtl", "mtllib", "usemap", "maplib",
      "cstype",   "deg",  "bmat",       "step",      "curv",   "curv2",  "surf",   "parm",
      "trim",     "hole", "scrv",       "sp",        "end",    "con",    "bevel",  "c_interp",
      "d_interp", "lod",  "shadow_obj", "trace_obj", "ctech",  "stech",  "call",   "csh"};
  return kKnown.count(word) > 0;
}

std::string WhyNoObjFaces(const std::filesystem::path& file) {
  const std::string text = ReadTextFile(file);
  ContinuedLines lines(text);
  size_t num_points = 0, num_lines = 0, num_free_forms = 0, num_known = 0;
  std::string unknown;
  while (lines.Next()) {
    if (lines.text().empty() || lines.text().front() == '#') continue;
    const std::string keyword = LowerCase(lines.keyword());
    if (IsObjKeyword(keyword)) {
      ++num_known;
    } else if (unknown.empty()) {
      unknown = "line " + std::to_string(lines.number()) + " is " + Quote(lines.text());
    }
    if (keyword == "v") ++num_points;
    if (keyword == "l") ++num_lines;
    if (keyword == "curv" || keyword == "curv2" || keyword == "surf") ++num_free_forms;
  }
  if (!unknown.empty() && num_known == 0) {
    return std::string(kNoFaces) + ", and nothing in it is as in an OBJ: " + unknown +
           "; expected lines as 'v 0 0 0' and 'f 1 2 3', their words parted by blanks";
  }
  std::vector<std::string> held;
  if (num_free_forms > 0) {
    held.push_back(CountOf(num_free_forms,
                           "free-form curve or surface",
                           "free-form curves and "
                           "surfaces") +
                   " (NURBS)");
  }
  if (num_lines > 0) held.push_back(CountOf(num_lines, "line", "lines"));
  if (num_points > 0) held.push_back(CountOf(num_points, "point", "points"));
  if (held.empty()) return kNoFaces;
  if (num_free_forms > 0) return ButHolds(held) + kTriangulate;
  if (num_lines > 0) return ButHolds(held) + kExportFaces;
  return ButHolds(held) + "; a cloud of points cannot be textured: make a mesh of it first";
}

struct GltfHeld {
  size_t num_meshes = 0;
  size_t num_points = 0;  // primitives of each kind
  size_t num_lines = 0;
};

// `is_counted`: of each node, so that damaged files with loops end.
void CountNode(const tinygltf::Model& gltf,
               int index,
               int depth,
               std::vector<bool>& is_counted,
               GltfHeld& held) {
  constexpr int kDeepest = 64;
  if (depth > kDeepest || index < 0 || static_cast<size_t>(index) >= gltf.nodes.size()) return;
  if (is_counted[static_cast<size_t>(index)]) return;
  is_counted[static_cast<size_t>(index)] = true;
  const tinygltf::Node& node = gltf.nodes[static_cast<size_t>(index)];
  if (node.mesh >= 0 && static_cast<size_t>(node.mesh) < gltf.meshes.size()) {
    ++held.num_meshes;
    for (const tinygltf::Primitive& part : gltf.meshes[static_cast<size_t>(node.mesh)].primitives) {
      if (part.mode == TINYGLTF_MODE_POINTS) ++held.num_points;
      if (part.mode >= TINYGLTF_MODE_LINE && part.mode <= TINYGLTF_MODE_LINE_STRIP)
        ++held.num_lines;
    }
  }
  for (const int child : node.children) CountNode(gltf, child, depth + 1, is_counted, held);
}

GltfHeld CountScene(const tinygltf::Model& gltf, size_t scene) {
  GltfHeld held;
  std::vector<bool> is_counted(gltf.nodes.size());
  for (const int node : gltf.scenes[scene].nodes) CountNode(gltf, node, 0, is_counted, held);
  return held;
}

}  // namespace

std::string WhyNoFaces(const std::filesystem::path& file) {
  if (LowerCase(file.extension().string()) == ".obj") {
    // Under a model's name anything may have been saved.
    const ImageKind kind = FindImageKind(file);
    if (kind.IsImage()) return "this is " + kind.description + " and no model";
    return WhyNoObjFaces(file);
  }
  return std::string(kNoFaces) + kExportFaces;
}

std::string WhyNoGltfFaces(const tinygltf::Model& gltf, int scene) {
  const GltfHeld held = CountScene(gltf, static_cast<size_t>(scene));
  std::vector<std::string> parts;
  if (held.num_lines > 0) parts.push_back(CountOf(held.num_lines, "set of lines", "sets of lines"));
  if (held.num_points > 0) {
    parts.push_back(CountOf(held.num_points, "set of points", "sets of points"));
  }
  if (!parts.empty()) return ButHolds(parts) + kExportFaces;
  if (gltf.meshes.empty()) {
    if (!gltf.cameras.empty()) parts.push_back(CountOf(gltf.cameras.size(), "camera", "cameras"));
    return parts.empty() ? kNoFaces + std::string(kExportFaces) : ButHolds(parts) + kExportFaces;
  }
  if (held.num_meshes > 0) return kNoFaces + std::string(kExportFaces);
  for (size_t other = 0; other < gltf.scenes.size(); ++other) {
    if (CountScene(gltf, other).num_meshes == 0) continue;
    const std::string& name = gltf.scenes[other].name;
    return "the scene that it shows (" + std::to_string(scene) +
           ") is empty, and its meshes are "
           "in scene " +
           std::to_string(other) + (name.empty() ? "" : " (" + Quote(name) + ")") +
           "; export that scene alone, or write \"scene\": " + std::to_string(other) +
           " in its JSON";
  }
  return "no scene shows any of its " + CountOf(gltf.meshes.size(), "mesh", "meshes") +
         "; export it with what is visible in it";
}

}  // namespace groundglass
