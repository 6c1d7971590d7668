// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
//
// A script for Blender (3.4 or later): cameras with shift and oblong pixels, which glTF's cameras
// cannot have, each with its photograph behind it.
#include "exchange/formats.h"
#include "exchange/json_numbers.h"
#include "exchange/rules.h"

namespace groundglass {
namespace {

// What the script does with its list; Blender's own words.
constexpr char kScript[] = R"py(

import bpy
from mathutils import Matrix

# The frame belongs to the scene and not to the camera: call use(NAME) to render one of them.
def use(name):
    camera = bpy.data.objects[name]
    render = bpy.context.scene.render
    bpy.context.scene.camera = camera
    render.resolution_x, render.resolution_y = camera["size_px"]
    render.resolution_percentage = 100
    render.pixel_aspect_x, render.pixel_aspect_y = camera["pixel_aspect"]


def add(entry):
    data = bpy.data.cameras.new(entry["name"])
    data.sensor_fit = "HORIZONTAL"
    data.sensor_width = 36
    data.lens = entry["lens_mm"]
    data.shift_x, data.shift_y = entry["shift"]
    data.clip_end = 1e5
    camera = bpy.data.objects.new(entry["name"], data)
    camera.matrix_world = Matrix(entry["matrix_world"])
    camera["size_px"] = entry["size_px"]
    camera["pixel_aspect"] = entry["pixel_aspect"]
    bpy.context.scene.collection.objects.link(camera)
    if entry["photograph"]:
        path = os.path.join(FOLDER, entry["photograph"])
        if os.path.exists(path):
            behind = data.background_images.new()
            behind.image = bpy.data.images.load(path)
            data.show_background_images = True


for entry in CAMERAS:
    add(entry)
if MODEL and os.path.exists(os.path.join(FOLDER, MODEL)):
    bpy.ops.wm.obj_import(filepath=os.path.join(FOLDER, MODEL), forward_axis="Y", up_axis="Z")
if CAMERAS:
    use(CAMERAS[0]["name"])
)py";

nlohmann::ordered_json BlenderCamera(const ExchangeCamera& each,
                                     const std::filesystem::path& folder) {
  const Camera& camera = each.camera;
  const Eigen::Vector2d shift = BlenderShift(camera);
  // The narrower side of a pixel counts 1.
  const double ratio = camera.focal_y_px / camera.focal_x_px;
  nlohmann::ordered_json json;
  json["name"] = each.name;
  json["size_px"] = {camera.width_px, camera.height_px};
  json["lens_mm"] = 36 * camera.focal_x_px / camera.width_px;
  json["shift"] = {shift.x(), shift.y()};
  json["pixel_aspect"] = {ratio > 1 ? ratio : 1.0, ratio > 1 ? 1.0 : 1 / ratio};
  json["matrix_world"] = RowsJson(WorldFromGlCam(camera));
  json["photograph"] =
      each.image_file.empty() ? "" : each.image_file.lexically_proximate(folder).generic_string();
  return json;
}

}  // namespace

std::vector<FileToWrite> FormatBlender(const ExchangeScene& scene,
                                       const std::filesystem::path& out) {
  const std::filesystem::path folder = out.parent_path();
  nlohmann::ordered_json cameras = nlohmann::ordered_json::array();
  for (const ExchangeCamera& camera : scene.cameras) {
    cameras.push_back(BlenderCamera(camera, folder));
  }
  // JSON's strings, numbers and lists are Python's too.
  const nlohmann::ordered_json model =
      scene.model_file.extension() == ".obj"
          ? scene.model_file.lexically_proximate(folder).generic_string()
          : std::string();
  return {{out,
           "# Groundglass: cameras for Blender. blender --python " + out.filename().string() +
               "\nimport os\n\nFOLDER = os.path.dirname(os.path.abspath(__file__))\nMODEL = " +
               model.dump() + "\nCAMERAS = " + DumpJson(cameras) + kScript}};
}

}  // namespace groundglass
