// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/mesh_io.h"

#include "scene/error.h"
#include "scene/text.h"

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>

namespace groundglass {
namespace {

void AppendMesh(const aiMesh& mesh, const aiMatrix4x4& transform, PolygonModel& model) {
  const int first = static_cast<int>(model.points_in_world.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D point = transform * mesh.mVertices[i];
    model.points_in_world.emplace_back(point.x, point.y, point.z);
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& corners = mesh.mFaces[i];
    if (corners.mNumIndices < 3) continue;  // points and lines
    Face& face = model.faces.emplace_back();
    for (unsigned k = 0; k < corners.mNumIndices; ++k) {
      const unsigned index = corners.mIndices[k];
      // Left for the check of faces to find.
      face.points.push_back(index < mesh.mNumVertices ? first + static_cast<int>(index) : -1);
    }
  }
}

void AppendNode(const aiScene& scene,
                const aiNode& node,
                const aiMatrix4x4& parent,
                PolygonModel& model) {
  const aiMatrix4x4 transform = parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    AppendMesh(*scene.mMeshes[node.mMeshes[i]], transform, model);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    AppendNode(scene, *node.mChildren[i], transform, model);
  }
}

// Assimp believes a PLY header's counts, however large; each element takes a byte at least.
void CheckPlyCounts(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const uintmax_t size = std::filesystem::file_size(file);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::vector<TextLine> lines = SplitLines(line, '\0');
    if (lines.empty() || lines.front().tokens.empty()) continue;
    const std::vector<TextToken>& words = lines.front().tokens;
    if (words.front().text == "end_header") break;
    if (words.front().text != "element" || words.size() < 3) continue;
    const std::optional<long long> count = ParseInteger(words[2].text);
    if (!count || *count < 0 || static_cast<uintmax_t>(*count) > size) {
      throw Error(
          file, number, "the file is too short for " + std::string(words[2].text) + " elements");
    }
  }
}

}  // namespace

PolygonModel ReadPlainMesh(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw Error(file, "no such model file");
  if (LowerCase(file.extension().string()) == ".ply") CheckPlyCounts(file);
  Assimp::Importer importer;
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFile(file.string(), 0);
  } catch (const std::exception& exception) {
    throw Error(file, std::string("cannot read this model: ") + exception.what());
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string reason = importer.GetErrorString();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error(file, "cannot read this model: " + reason);
  }
  PolygonModel model;
  AppendNode(*scene, *scene->mRootNode, aiMatrix4x4(), model);
  for (const Eigen::Vector3d& point : model.points_in_world) {
    if (!point.allFinite()) throw Error(file, "a point's coordinates are not finite numbers");
  }
  JoinIdenticalPoints(model);
  return model;
}

void JoinIdenticalPoints(PolygonModel& model) {
  std::map<std::array<double, 3>, int> joined;
  std::vector<Eigen::Vector3d> points;
  std::vector<int> new_index(model.points_in_world.size());
  for (size_t i = 0; i < model.points_in_world.size(); ++i) {
    const Eigen::Vector3d& point = model.points_in_world[i];
    const auto [place, is_new] =
        joined.try_emplace({point.x(), point.y(), point.z()}, static_cast<int>(points.size()));
    if (is_new) points.push_back(point);
    new_index[i] = place->second;
  }
  model.points_in_world = std::move(points);
  for (Face& face : model.faces) {
    for (int& point : face.points) {
      if (point >= 0) point = new_index[static_cast<size_t>(point)];
    }
  }
}

std::vector<int> FindUsableFaces(const PolygonModel& model,
                                 const std::filesystem::path& file,
                                 const std::vector<int>& lines,
                                 std::vector<std::string>& warnings) {
  std::vector<int> usable;
  int num_unusable = 0;
  std::string first_fault;
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    const FaceCheck check = CheckFace(model, face);
    const std::string about = DescribeFace(model, face) + " ";
    if (!check.fault.empty()) {
      if (num_unusable++ == 0) {
        first_fault = about + check.fault;
        if (!lines.empty()) {
          first_fault += " (line " + std::to_string(lines[static_cast<size_t>(face)]) + ")";
        }
      }
      continue;
    }
    if (!check.warning.empty()) {
      warnings.push_back(
          lines.empty()
              ? Error(file, about + check.warning).what()
              : Error(file, lines[static_cast<size_t>(face)], about + check.warning).what());
    }
    usable.push_back(face);
  }
  if (num_unusable > 0) {
    warnings.push_back(
        Error(file,
              (num_unusable == 1 ? std::string("1 face that cannot be used is left out: ")
                                 : std::to_string(num_unusable) +
                                       " faces that cannot be used are left out; the first: ") +
                  first_fault)
            .what());
  }
  return usable;
}

void KeepFaces(PolygonModel& model, const std::vector<int>& faces) {
  if (faces.size() == model.faces.size()) return;
  std::vector<Face> kept;
  for (const int face : faces) kept.push_back(std::move(model.faces[static_cast<size_t>(face)]));
  model.faces = std::move(kept);
}

}  // namespace groundglass
