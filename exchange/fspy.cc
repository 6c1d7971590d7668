// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
//
// fSpy's project file: stuffmatic/fSpy, project_file_format.md. It starts with "fspy", a version,
// and the sizes of JSON and picture, which follow.
#include "exchange/formats.h"
#include "exchange/json_numbers.h"
#include "exchange/rules.h"
#include "scene/error.h"
#include "scene/formats/json_fault.h"
#include "scene/formats/view_io.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace groundglass {
namespace {

using Json = nlohmann::ordered_json;

constexpr uint32_t kFspyVersion = 1;
constexpr size_t kFspyHeadBytes = 16;

std::string FspyWord(uint32_t value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

// The longer side reaches from -1 to 1.
double RelativeFocal(const Camera& camera) {
  return 2 * camera.focal_x_px / std::max(camera.width_px, camera.height_px);
}

Json FspyJson(const Camera& camera) {
  const Eigen::Matrix4d world_from_gl_cam = WorldFromGlCam(camera);
  const Eigen::Vector2d center = CenterOnImagePlane(camera);
  Json parameters;
  parameters["principalPoint"] = {{"x", center.x()}, {"y", center.y()}};
  parameters["viewTransform"] = {{"rows", RowsJson(Eigen::Matrix4d(world_from_gl_cam.inverse()))}};
  parameters["cameraTransform"] = {{"rows", RowsJson(world_from_gl_cam)}};
  parameters["horizontalFieldOfView"] = 2 * std::atan(camera.width_px / (2 * camera.focal_x_px));
  parameters["verticalFieldOfView"] = 2 * std::atan(camera.height_px / (2 * camera.focal_x_px));
  parameters["vanishingPoints"] = Json::array();
  parameters["vanishingPointAxes"] = {"xPositive", "yPositive", "zPositive"};
  parameters["relativeFocalLength"] = RelativeFocal(camera);
  parameters["imageWidth"] = camera.width_px;
  parameters["imageHeight"] = camera.height_px;
  Json json;
  json["id"] = "groundglass";
  json["calibrationSettingsBase"] = {{"referenceDistanceUnit", "No unit"},
                                     {"referenceDistance", 1},
                                     {"referenceDistanceAxis", nullptr},
                                     {"cameraData", {{"presetId", nullptr}}},
                                     {"firstVanishingPointAxis", "xPositive"},
                                     {"secondVanishingPointAxis", "yPositive"}};
  json["cameraParameters"] = parameters;
  return json;
}

uint32_t ReadFspyWord(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// The project's JSON, as text.
std::string FspyJsonText(const std::filesystem::path& file) {
  const std::string bytes = ReadFileBytes(file);
  if (bytes.size() < kFspyHeadBytes || !bytes.starts_with("fspy")) {
    throw Error(file, "is no project of fSpy's: it does not begin with fspy");
  }
  if (ReadFspyWord(bytes, 4) != kFspyVersion) {
    throw Error(file,
                "is a project of fSpy's version " + std::to_string(ReadFspyWord(bytes, 4)) +
                    ", of which nothing is known; save it as version 1");
  }
  const size_t json_bytes = ReadFspyWord(bytes, 8);
  if (json_bytes > bytes.size() - kFspyHeadBytes) throw Error(file, "is cut short");
  return bytes.substr(kFspyHeadBytes, json_bytes);
}

Camera FspyCamera(const std::filesystem::path& file, const Json& json) {
  const Json& parameters = json.at("cameraParameters");
  if (parameters.is_null()) throw Error(file, "holds no camera yet: fSpy has not solved it");
  Camera camera;
  SetSize(parameters.at("imageWidth").get<double>(),
          parameters.at("imageHeight").get<double>(),
          camera);
  const double angle = parameters.at("horizontalFieldOfView").get<double>();
  camera.focal_x_px = camera.focal_y_px = camera.width_px / (2 * std::tan(angle / 2));
  const Json& center = parameters.at("principalPoint");
  SetCenterOnImagePlane({center.at("x").get<double>(), center.at("y").get<double>()}, camera);
  SetPoseFromGlCam(MatrixFromJson<4, 4>(parameters.at("cameraTransform").at("rows")), camera);
  return camera;
}

}  // namespace

std::vector<FileToWrite> FormatFspy(const ExchangeScene& scene, const std::filesystem::path& out) {
  std::vector<FileToWrite> files;
  for (const ExchangeCamera& each : scene.cameras) {
    const std::string json = FspyJson(each.camera).dump();
    const std::string picture =
        each.image_file.empty() ? std::string() : ReadFileBytes(each.image_file);
    std::string bytes = "fspy" + FspyWord(kFspyVersion) +
                        FspyWord(static_cast<uint32_t>(json.size())) +
                        FspyWord(static_cast<uint32_t>(picture.size())) + json + picture;
    files.push_back({out / (each.name + ".fspy"), std::move(bytes)});
  }
  return files;
}

std::vector<ForeignCamera> ReadFspy(const std::filesystem::path& file) {
  return {ReadForeignCamera(file, file.stem().string(), file.string(), [&] {
    try {
      return FspyCamera(file, Json::parse(FspyJsonText(file)));
    } catch (const Json::exception& error) {
      throw Error(file, "is not as fSpy writes a project: " + TellJsonFault(error.what()));
    }
  })};
}

}  // namespace groundglass
