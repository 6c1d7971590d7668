// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
//
// mvs-texturing's .cam: nmoehrle/mvs-texturing, libs/tex/generate_texture_views.cpp. Its pictures
// lie beside, and its own undistortion does not heed the principal point: there is none to do.
#include "exchange/formats.h"
#include "exchange/rules.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

namespace groundglass {
namespace {

std::string FormatCam(const Camera& camera) {
  const RigidTransform& pose = camera.cam_from_world;
  std::string text;
  for (int i = 0; i < 3; ++i) text += FormatNumber(pose.translation[i]) + " ";
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      text += FormatNumber(pose.rotation(row, column)) + (row + column == 4 ? "\n" : " ");
    }
  }
  // The focal length is a share of the longer side.
  const bool is_wide = camera.width_px >= camera.height_px;
  const double focal =
      is_wide ? camera.focal_x_px / camera.width_px : camera.focal_y_px / camera.height_px;
  const Eigen::Vector2d center = CenterAsShare(camera);
  return text + FormatNumber(focal) + " 0 0 " +
         FormatNumber(camera.focal_y_px / camera.focal_x_px) + " " + FormatNumber(center.x()) +
         " " + FormatNumber(center.y()) + "\n";
}

}  // namespace

std::vector<FileToWrite> FormatMvsTexturing(const ExchangeScene& scene,
                                            const std::filesystem::path& out) {
  std::vector<FileToWrite> files;
  for (const ExchangeCamera& each : scene.cameras) {
    files.push_back({out / (each.name + ".cam"), FormatCam(each.camera)});
  }
  return files;
}

}  // namespace groundglass
