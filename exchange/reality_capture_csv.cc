// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
//
// RealityCapture's and RealityScan's "Internal/External camera parameters": a table of cameras that
// many programs read. As with its XMP, what px and py are shares of is told differently, so that
// pictures are centred; the angles are those of rules.h, checked against an export of its own.
#include "exchange/formats.h"
#include "exchange/rules.h"
#include "scene/formats/csv.h"
#include "scene/text.h"

#include <algorithm>

namespace groundglass {
namespace {

std::string TableRow(const ExchangeCamera& each) {
  const Camera& camera = each.camera;
  const Eigen::Vector3d position = camera.PositionInWorld();
  const HeadingPitchRoll angles = HeadingPitchRollOf(camera);
  // 36 mm are the longer side.
  const double focal_mm = 36 * camera.focal_x_px / std::max(camera.width_px, camera.height_px);
  std::string row = CsvField(each.image_name);
  for (const double value : {position.x(),
                             position.y(),
                             position.z(),
                             angles.heading_deg,
                             angles.pitch_deg,
                             angles.roll_deg,
                             focal_mm}) {
    row += "," + FormatNumber(value + 0.0);
  }
  return row + ",0,0,0,0,0,0,0,0\n";  // px py k1 k2 k3 k4 t1 t2
}

}  // namespace

std::vector<FileToWrite> FormatRealityCaptureCsv(const ExchangeScene& scene,
                                                 const std::filesystem::path& out) {
  std::string text = "#name,x,y,alt,heading,pitch,roll,f,px,py,k1,k2,k3,k4,t1,t2\n";
  for (const ExchangeCamera& camera : scene.cameras) text += TableRow(camera);
  return {{out / "cameras.csv", text}};
}

}  // namespace groundglass
