// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/bench/anchors/trackers.h"
#include "tests/bench/anchors/visp_edge_tracker.h"

#include <filesystem>
#include <fstream>

namespace groundglass {
namespace {

// The model as a file, which is all that the tracker reads.
const std::string& CaoFile(const Castle& castle) {
  static const std::string file = [&] {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / "groundglass_anchors_castle.cao";
    std::ofstream(path) << castle.cao;
    return path.string();
  }();
  return file;
}

Method::Found Track(const Castle& castle,
                    const PerturbedStart& start,
                    const VispTracking& settings) {
  const Image8& grey8 = castle.frames[start.frame].grey8;
  Method::Found found{CameraFromTag(start.tag, grey8.width, grey8.height)};
  VispTracking tracking = settings;
  tracking.cao_file = CaoFile(castle);
  tracking.width_px = grey8.width;
  tracking.height_px = grey8.height;
  tracking.grey8 = grey8.values.data();
  tracking.focal_px = 700;
  tracking.center_x_px = 319.5;
  tracking.center_y_px = 239.5;

  RigidTransform& transform = found.camera.cam_from_world;
  const Eigen::Matrix3d rotation = transform.rotation * WorldFromVispAxes();
  VispPose pose;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) pose[4 * row + column] = rotation(row, column);
    pose[4 * row + 3] = transform.translation[row] / kWorldPerVisp;
  }
  pose = TrackWithVisp(tracking, pose);
  Eigen::Matrix3d tracked;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) tracked(row, column) = pose[4 * row + column];
    transform.translation[row] = pose[4 * row + 3] * kWorldPerVisp;
  }
  transform.rotation = tracked * WorldFromVispAxes().transpose();
  return found;
}

}  // namespace

std::vector<Method> VispMethods() {
  std::vector<Method> methods;
  for (const auto& [name, ranges_px] : {std::pair<std::string, std::vector<int>>("8", {8}),
                                        {"16", {16}},
                                        {"30", {30}},
                                        {"30, 15, 7", {30, 15, 7}},
                                        {"60, 30, 15, 7", {60, 30, 15, 7}}}) {
    for (const bool with_scan_lines : {false, true}) {
      VispTracking settings;
      settings.ranges_px = ranges_px;
      settings.repeats = ranges_px.size() == 1 ? 16 : 6;
      settings.with_scan_lines = with_scan_lines;
      methods.push_back({"ViSP",
                         "range " + name + (with_scan_lines ? ", scan lines" : ""),
                         [settings](const Castle& castle, const PerturbedStart& start) {
                           return Track(castle, start, settings);
                         }});
    }
  }
  return methods;
}

}  // namespace groundglass
