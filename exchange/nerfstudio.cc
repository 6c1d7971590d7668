// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
//
// nerfstudio's transforms.json: "Data conventions" of its documentation, and
// nerfstudio/data/dataparsers/nerfstudio_dataparser.py.
#include "exchange/formats.h"
#include "exchange/json_numbers.h"
#include "exchange/rules.h"
#include "scene/error.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

namespace groundglass {
namespace {

using Json = nlohmann::ordered_json;

Json NerfFrameJson(const ExchangeCamera& each, const std::filesystem::path& folder) {
  const Camera& camera = each.camera;
  Json frame;
  frame["file_path"] = each.image_file.empty()
                           ? each.name
                           : each.image_file.lexically_proximate(folder).generic_string();
  frame["transform_matrix"] = RowsJson(WorldFromGlCam(camera));
  // In each frame: one distortion at the top would turn all others off.
  frame["w"] = camera.width_px;
  frame["h"] = camera.height_px;
  frame["fl_x"] = camera.focal_x_px;
  frame["fl_y"] = camera.focal_y_px;
  frame["cx"] = camera.center_x_px;
  frame["cy"] = camera.center_y_px;
  frame["k1"] = camera.k1;
  frame["k2"] = camera.k2;
  frame["k3"] = camera.k3;
  frame["p1"] = camera.p1;
  frame["p2"] = camera.p2;
  return frame;
}

// A number of the frame, else of the whole file.
double NerfNumber(const Json& frame, const Json& file, const char* key, double otherwise) {
  return frame.value(key, file.value(key, otherwise));
}

NamedCamera NerfCamera(const Json& frame, const Json& file) {
  NamedCamera named;
  named.name = frame.at("file_path").get<std::string>();
  Camera& camera = named.camera;
  camera.width_px = static_cast<int>(NerfNumber(frame, file, "w", 0));
  camera.height_px = static_cast<int>(NerfNumber(frame, file, "h", 0));
  camera.focal_x_px = NerfNumber(frame, file, "fl_x", 0);
  camera.focal_y_px = NerfNumber(frame, file, "fl_y", camera.focal_x_px);
  camera.center_x_px = NerfNumber(frame, file, "cx", camera.width_px / 2.0);
  camera.center_y_px = NerfNumber(frame, file, "cy", camera.height_px / 2.0);
  camera.k1 = NerfNumber(frame, file, "k1", 0);
  camera.k2 = NerfNumber(frame, file, "k2", 0);
  camera.k3 = NerfNumber(frame, file, "k3", 0);
  camera.p1 = NerfNumber(frame, file, "p1", 0);
  camera.p2 = NerfNumber(frame, file, "p2", 0);
  Eigen::Matrix4d world_from_gl_cam = MatrixFromJson<4, 4>(frame.at("transform_matrix"));
  if (file.contains("applied_transform")) {
    // What its importer turned the world by before it wrote the file.
    Eigen::Matrix4d applied = Eigen::Matrix4d::Identity();
    applied.topRows<3>() = MatrixFromJson<3, 4>(file.at("applied_transform"));
    world_from_gl_cam = applied.inverse() * world_from_gl_cam;
  }
  SetPoseFromGlCam(world_from_gl_cam, camera);
  return named;
}

}  // namespace

std::vector<FileToWrite> FormatNerfstudio(const ExchangeScene& scene,
                                          const std::filesystem::path& out) {
  Json json;
  json["camera_model"] = "OPENCV";
  json["orientation_override"] = "none";
  json["frames"] = Json::array();
  for (const ExchangeCamera& camera : scene.cameras) {
    json["frames"].push_back(NerfFrameJson(camera, out.parent_path()));
  }
  return {{out, DumpJson(json)}};
}

std::vector<NamedCamera> ReadNerfstudio(const std::filesystem::path& file) {
  try {
    const Json json = Json::parse(ReadTextFile(file));
    std::vector<NamedCamera> cameras;
    for (const Json& frame : json.at("frames")) cameras.push_back(NerfCamera(frame, json));
    return cameras;
  } catch (const Json::exception& error) {
    throw Error(file, "is not as nerfstudio writes transforms.json: " + OneLine(error.what()));
  }
}

}  // namespace groundglass
