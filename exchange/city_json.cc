// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/city_json.h"

#include "exchange/json_numbers.h"
#include "scene/face_outline.h"
#include "scene/formats/image_io.h"
#include "scene/frames.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

using Json = nlohmann::ordered_json;

// Tenths of a millimetre.
constexpr double kVertexStepM = 1e-4;

const char* SurfaceKind(const FacePlane& plane) {
  constexpr double kSteep = 0.3;  // sine of the slope above which a roof begins
  if (plane.normal_in_world.z() > kSteep) return "RoofSurface";
  return plane.normal_in_world.z() < -0.9 ? "GroundSurface" : "WallSurface";
}

// A face's corners by loops: the outer one, then its holes.
std::vector<std::vector<int>> LoopsOfFace(const PolygonModel& model, int face) {
  const std::vector<int>& points = model.faces[face].points;
  const FacePlane plane = ComputeFacePlane(model, face);
  const Eigen::Vector3d across = plane.normal_in_world.unitOrthogonal();
  const Eigen::Vector3d up = plane.normal_in_world.cross(across);
  std::vector<Eigen::Vector2d> outline;
  for (const int point : points) {
    outline.emplace_back(model.points_in_world[point].dot(across),
                         model.points_in_world[point].dot(up));
  }
  const OutlineLoops parted = PartOutline(outline, 1e-9 * ComputeBounds(model).Diagonal(), false);
  std::vector<std::vector<int>> loops;
  for (const OutlineLoops::Loop& loop : parted.loops) {
    if (loop.inside_of < 0) loops.insert(loops.begin(), loop.corners);
  }
  for (const OutlineLoops::Loop& loop : parted.loops) {
    if (loop.inside_of >= 0) loops.push_back(loop.corners);
  }
  if (loops.empty()) {
    loops.emplace_back();
    for (size_t i = 0; i < points.size(); ++i) loops[0].push_back(static_cast<int>(i));
  }
  return loops;
}

// Rings of places on the page, from 0 to 1 and v from below; each with the page before it.
Json TextureRings(const TexturedModel& textured,
                  int face,
                  const std::vector<std::vector<int>>& loops,
                  Json& texture_vertices) {
  Json rings = Json::array();
  const FaceTexture none;
  const FaceTexture& texture = textured.faces.empty() ? none : textured.faces[face];
  for (const std::vector<int>& loop : loops) {
    Json ring = Json::array();
    if (texture.page < 0) {
      ring.push_back(nullptr);
    } else {
      const Image8& page = textured.pages[texture.page].srgb8;
      ring.push_back(texture.page);
      for (const int corner : loop) {
        const Eigen::Vector2d& texel = texture.corners_texel[corner];
        ring.push_back(texture_vertices.size());
        texture_vertices.push_back({texel.x() / page.width, 1 - texel.y() / page.height});
      }
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace

std::vector<FileToWrite> FormatCityJson(const TexturedModel& textured,
                                        const std::filesystem::path& out) {
  const PolygonModel& model = textured.model;
  const double metres = MetresPerUnit(model.unit);
  const Box bounds = ComputeBounds(model);
  const Eigen::Vector3d origin_m = (bounds.min * metres).array().floor();

  Json vertices = Json::array();
  for (const Eigen::Vector3d& point : model.points_in_world) {
    const Eigen::Vector3d steps = (point * metres - origin_m) / kVertexStepM;
    vertices.push_back({std::llround(steps.x()), std::llround(steps.y()), std::llround(steps.z())});
  }
  Json boundaries = Json::array();
  Json surfaces = Json::array();
  Json surface_values = Json::array();
  Json texture_values = Json::array();
  Json texture_vertices = Json::array();
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    const std::vector<std::vector<int>> loops = LoopsOfFace(model, face);
    Json rings = Json::array();
    for (const std::vector<int>& loop : loops) {
      Json ring = Json::array();
      for (const int corner : loop) ring.push_back(model.faces[face].points[corner]);
      rings.push_back(std::move(ring));
    }
    boundaries.push_back(std::move(rings));
    Json surface = {{"type", SurfaceKind(ComputeFacePlane(model, face))}};
    if (!model.faces[face].name.empty()) surface["name"] = model.faces[face].name;
    surface["face"] = FaceNumber(model, face);
    surfaces.push_back(std::move(surface));
    surface_values.push_back(face);
    texture_values.push_back(TextureRings(textured, face, loops, texture_vertices));
  }
  Json geometry = {{"type", "MultiSurface"},
                   {"lod", "3"},
                   {"boundaries", boundaries},
                   {"semantics", {{"surfaces", surfaces}, {"values", surface_values}}}};
  Json json;
  json["type"] = "CityJSON";
  json["version"] = "2.0";
  json["transform"] = {{"scale", {kVertexStepM, kVertexStepM, kVertexStepM}},
                       {"translate", {origin_m.x(), origin_m.y(), origin_m.z()}}};
  std::vector<FileToWrite> files;
  if (!textured.pages.empty()) {
    geometry["texture"] = {{"photographs", {{"values", texture_values}}}};
    Json textures = Json::array();
    for (size_t i = 0; i < textured.pages.size(); ++i) {
      const std::string picture = out.stem().stem().string() + "_" + std::to_string(i) + ".jpg";
      textures.push_back({{"type", "JPG"}, {"image", picture}});
      files.push_back({out.parent_path() / picture,
                       std::string(AsText(EncodeImage(textured.pages[i].srgb8, ".jpg")))});
    }
    json["appearance"] = {{"textures", textures}, {"vertices-texture", texture_vertices}};
  }
  json["CityObjects"] = {
      {"building", {{"type", "Building"}, {"geometry", Json::array({geometry})}}}};
  json["vertices"] = vertices;
  files.push_back({out, json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"});
  return files;
}

}  // namespace groundglass
