// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/tiles1988/tiles.h"
#include "scene/error.h"
#include "scene/face_number.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/formats/json_fault.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/view_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void SetFile(const fs::path& folder, const char* key, const fs::path& file, Json& json) {
  json[key] = fs::absolute(file).lexically_normal().lexically_relative(folder).generic_string();
}

std::optional<fs::path> GetFile(const fs::path& folder, const char* key, const Json& json) {
  if (!json.contains(key)) return std::nullopt;
  return (folder / json.at(key).get<std::string>()).lexically_normal();
}

// Whether the face turns its front to the camera and one of its corners is before it.
bool MayBeSeen(const PolygonModel& model, int face, const Camera& camera) {
  const FacePlane plane = ComputeFacePlane(model, face);
  if (plane.normal_in_world.dot(camera.PositionInWorld()) <= plane.offset) return false;
  const std::vector<int>& points = model.faces[face].points;
  return std::any_of(points.begin(), points.end(), [&](int point) {
    return (camera.cam_from_world * model.points_in_world[point]).z() > 0;
  });
}

}  // namespace

void WriteTileRecord(const fs::path& folder, const TileRecord& record) {
  constexpr double kLookatDistance = 100;  // model's unit; any will do
  const fs::path absolute = fs::absolute(folder).lexically_normal();
  Json photographs = Json::array();
  for (const BakePhotograph& photograph : record.photographs) {
    if (!photograph.faces || photograph.faces->empty()) continue;
    WriteFileAtomically(folder / "views" / (photograph.name + ".view"),
                        FormatView(TagFromCamera(photograph.camera, kLookatDistance)));
    Json json;
    json["name"] = photograph.name;
    SetFile(absolute, "image", photograph.image_file, json);
    if (photograph.mask_file) SetFile(absolute, "mask", *photograph.mask_file, json);
    if (photograph.faces_file) SetFile(absolute, "painted_faces", *photograph.faces_file, json);
    std::vector<int> faces = *photograph.faces;
    for (int& face : faces) face = FaceNumber(record.model, face);
    json["faces"] = faces;
    photographs.push_back(json);
  }
  WriteFileAtomically(folder / "model.osu", FormatOsu(record.model));
  const Json json = {{"downsample", record.options.downsample}, {"photographs", photographs}};
  WriteFileAtomically(folder / "record.json", json.dump(1) + "\n");
}

TileRecord ReadTileRecord(const fs::path& folder) {
  const fs::path file = folder / "record.json";
  TileRecord record;
  record.model = ReadOsu(folder / "model.osu").model;
  try {
    const Json json = Json::parse(ReadTextFile(file));
    record.options.downsample = json.at("downsample").get<int>();
    for (const Json& entry : json.at("photographs")) {
      BakePhotograph& photograph = record.photographs.emplace_back();
      photograph.name = entry.at("name").get<std::string>();
      photograph.image_file = GetFile(folder, "image", entry).value();
      photograph.mask_file = GetFile(folder, "mask", entry);
      photograph.faces_file = GetFile(folder, "painted_faces", entry);
      photograph.faces = entry.at("faces").get<std::vector<int>>();
      for (int& face : *photograph.faces) {
        const auto found = FindFaceByNumber(record.model, face);
        if (!found) {
          throw Error(file, "names face " + std::to_string(face) + ", which the model has not");
        }
        face = *found;
      }
      const ImageSize size = ReadImageSize(photograph.image_file);
      photograph.camera = CameraFromTag(
          ReadView(folder / "views" / (photograph.name + ".view")), size.width, size.height);
    }
  } catch (const nlohmann::json::exception& exception) {
    throw Error(file, "is no record of tiles: " + TellJsonFault(exception.what()));
  } catch (const std::bad_optional_access&) {
    throw Error(file, "is no record of tiles: a photograph without an image");
  }
  record.options.Check();
  return record;
}

void RecomputeTiles(const TileRecord& record, const Camera& camera, const TileSink& sink) {
  const Visibility visibility(record.model);
  for (const BakePhotograph& photograph : record.photographs) {
    std::vector<int> faces;
    for (const int face : photograph.faces.value_or(std::vector<int>())) {
      if (MayBeSeen(record.model, face, camera)) faces.push_back(face);
    }
    MakeTiles(record.model, visibility, photograph, faces, record.options, sink);
  }
}

}  // namespace groundglass
