// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
//
// nerfstudio's transforms.json: "Data conventions" of its documentation, and
// nerfstudio/data/dataparsers/nerfstudio_dataparser.py.
#include "exchange/formats.h"
#include "exchange/json_numbers.h"
#include "exchange/rules.h"
#include "scene/error.h"
#include "scene/formats/json_fault.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <cmath>

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

double RequiredNerfNumber(const Json& frame, const Json& file, const char* key) {
  return (frame.contains(key) ? frame : file).at(key).get<double>();
}

// Its lenses of other kinds have the same keys with another meaning.
void RequirePinhole(const Json& frame, const Json& file) {
  const std::string model =
      frame.value("camera_model", file.value("camera_model", std::string("OPENCV")));
  for (const char* known : {"OPENCV", "PINHOLE", "SIMPLE_PINHOLE", "RADIAL", "SIMPLE_RADIAL"}) {
    if (model == known) return;
  }
  throw Error("camera_model is " + Quote(model) + "; of nerfstudio's, OPENCV and PINHOLE are read");
}

// What its importer turned, moved and then scaled the world by before it wrote the file is undone.
Eigen::Matrix4d NerfPose(const Json& frame, const Json& file) {
  Eigen::Matrix4d world_from_gl_cam = MatrixFromJson<4, 4>(frame.at("transform_matrix"));
  const double scale = file.value("applied_scale", 1.0);
  if (!(scale > 0 && std::isfinite(scale))) {
    throw Error("applied_scale must be above 0, not " + FormatNumber(scale));
  }
  world_from_gl_cam.topRightCorner<3, 1>() /= scale;
  if (file.contains("applied_transform")) {
    Eigen::Matrix4d applied = Eigen::Matrix4d::Identity();
    applied.topRows<3>() = MatrixFromJson<3, 4>(file.at("applied_transform"));
    world_from_gl_cam = applied.inverse() * world_from_gl_cam;
  }
  return world_from_gl_cam;
}

Camera NerfCamera(const Json& frame, const Json& file) {
  RequirePinhole(frame, file);
  if (NerfNumber(frame, file, "k4", 0) != 0) {
    throw Error("k4 is no part of our lens; undistort the pictures first");
  }
  Camera camera;
  SetSize(RequiredNerfNumber(frame, file, "w"), RequiredNerfNumber(frame, file, "h"), camera);
  camera.focal_x_px = RequiredNerfNumber(frame, file, "fl_x");
  camera.focal_y_px = NerfNumber(frame, file, "fl_y", camera.focal_x_px);
  camera.center_x_px = NerfNumber(frame, file, "cx", camera.width_px / 2.0);
  camera.center_y_px = NerfNumber(frame, file, "cy", camera.height_px / 2.0);
  camera.k1 = NerfNumber(frame, file, "k1", 0);
  camera.k2 = NerfNumber(frame, file, "k2", 0);
  camera.k3 = NerfNumber(frame, file, "k3", 0);
  camera.p1 = NerfNumber(frame, file, "p1", 0);
  camera.p2 = NerfNumber(frame, file, "p2", 0);
  SetPoseFromGlCam(NerfPose(frame, file), camera);
  return camera;
}

// "images/a.jpg"; empty if the frame does not say.
std::string NerfPicture(const Json& frame) {
  const auto path = frame.is_object() ? frame.find("file_path") : frame.end();
  return path != frame.end() && path->is_string() ? path->get<std::string>() : std::string();
}

ForeignCamera ReadNerfFrame(const std::filesystem::path& file,
                            const Json& json,
                            const Json& frame,
                            size_t index) {
  const std::string name = NerfPicture(frame);
  const std::string place = file.string() + ": frame " + std::to_string(index + 1) +
                            (name.empty() ? "" : " (" + name + ")");
  return ReadForeignCamera(file, name, place, [&] {
    if (name.empty()) throw Error("has no file_path, and so no picture");
    try {
      return NerfCamera(frame, json);
    } catch (const Json::exception& error) {
      throw Error(TellJsonFault(error.what()));
    }
  });
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

std::vector<ForeignCamera> ReadNerfstudio(const std::filesystem::path& file) {
  std::vector<ForeignCamera> cameras;
  try {
    const Json json = Json::parse(ReadTextFile(file));
    for (const Json& frame : json.at("frames")) {
      cameras.push_back(ReadNerfFrame(file, json, frame, cameras.size()));
    }
  } catch (const Json::exception& error) {
    throw Error(file,
                "is not as nerfstudio writes transforms.json: " + TellJsonFault(error.what()));
  }
  if (cameras.empty()) throw Error(file, "has no frames, and so no camera");
  return cameras;
}

}  // namespace groundglass
