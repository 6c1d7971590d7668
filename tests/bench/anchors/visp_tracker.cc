// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/bench/anchors/visp_tracker.h"

#include "tests/bench/anchors/trackers.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace groundglass {

std::string WriteCao(const AnchorSet& set) {
  std::string name = "groundglass_anchors_" + set.name + ".cao";
  std::replace(name.begin(), name.end(), ' ', '_');
  const std::filesystem::path path = std::filesystem::temp_directory_path() / name;
  std::ofstream(path) << FormatCao(set);
  return path.string();
}

Camera TrackWithVisp(const AnchorSet& set,
                     const std::string& cao_file,
                     const Image8& grey8,
                     const Camera& start,
                     VispTracking settings) {
  settings.cao_file = cao_file;
  settings.width_px = grey8.width;
  settings.height_px = grey8.height;
  settings.grey8 = grey8.values.data();
  settings.focal_x_px = start.focal_x_px;
  settings.focal_y_px = start.focal_y_px;
  settings.center_x_px = start.center_x_px - 0.5;
  settings.center_y_px = start.center_y_px - 0.5;
  settings.edge_threshold = set.visp_edge_threshold;

  Camera found = start;
  RigidTransform& transform = found.cam_from_world;
  const Eigen::Matrix3d rotation = transform.rotation * set.world_from_visp;
  VispPose pose;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) pose[4 * row + column] = rotation(row, column);
    pose[4 * row + 3] = transform.translation[row] / kWorldPerVisp;
  }
  pose = TrackWithVisp(settings, pose);
  Eigen::Matrix3d tracked;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) tracked(row, column) = pose[4 * row + column];
    transform.translation[row] = pose[4 * row + 3] * kWorldPerVisp;
  }
  transform.rotation = tracked * set.world_from_visp.transpose();
  return found;
}

std::vector<Method> VispMethods(const AnchorSet& set) {
  const std::string cao_file = WriteCao(set);
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
      methods.push_back(
          {"ViSP",
           "range " + name + (with_scan_lines ? ", scan lines" : ""),
           [&set, cao_file, settings](const PerturbedStart& start) {
             const Image8& grey8 = set.frames[start.frame].grey8;
             const Camera camera = CameraFromTag(start.tag, grey8.width, grey8.height);
             return Method::Found{TrackWithVisp(set, cao_file, grey8, camera, settings)};
           }});
    }
  }
  return methods;
}

}  // namespace groundglass
