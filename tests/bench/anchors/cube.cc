// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/bench/anchors/cube.h"

#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"
#include "tests/bench/anchors/visp_tracker.h"

#include <cstdio>

namespace groundglass {
namespace {

constexpr int kNumVideoFrames = 217;
constexpr int kStep = 4;

// The pose of the first frame: translation, metres, and rotation vector, radians.
RigidTransform ReadFirstPose(const std::filesystem::path& file) {
  const std::string text = ReadTextFile(file);
  std::vector<double> numbers;
  for (const TextLine& line : SplitLines(text)) {
    for (const TextToken& token : line.tokens) {
      numbers.push_back(ParseNumber(token.text).value_or(0));
    }
  }
  if (numbers.size() != 6) throw Error(file, "expected six numbers");
  const Eigen::Vector3d turn(numbers[3], numbers[4], numbers[5]);
  return {Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix(),
          kWorldPerVisp * Eigen::Vector3d(numbers[0], numbers[1], numbers[2])};
}

PolygonModel CubeModel() {
  PolygonModel model;
  model.unit = LengthUnit::kMetre;
  const double side = 0.084 * kWorldPerVisp;
  for (const double z : {0.0, side}) {
    model.points_in_world.emplace_back(0, 0, z);
    model.points_in_world.emplace_back(-side, 0, z);
    model.points_in_world.emplace_back(-side, side, z);
    model.points_in_world.emplace_back(0, side, z);
  }
  for (const std::vector<int>& corners : {std::vector<int>{0, 4, 5, 1},
                                          {1, 5, 6, 2},
                                          {6, 7, 3, 2},
                                          {3, 7, 4, 0},
                                          {0, 1, 2, 3},
                                          {7, 6, 5, 4}}) {
    model.faces.push_back({corners, ""});
  }
  return model;
}

}  // namespace

Cube ReadCube(const std::filesystem::path& folder) {
  Cube cube;
  AnchorSet& set = cube.set;
  set.name = "cube";
  set.model = CubeModel();
  // As cube.xml, which comes with the video, has it.
  set.visp_edge_threshold = 5000;
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.focal_x_px = 547.7367575;
  camera.focal_y_px = 542.0744058;
  camera.center_x_px = 338.7036994 + 0.5;
  camera.center_y_px = 234.5083345 + 0.5;
  camera.cam_from_world = ReadFirstPose(folder / "cube.0.pos");
  Camera other_camera = camera;

  const std::string cao_file = WriteCao(set);
  VispTracking tracking;
  tracking.ranges_px = {7};
  tracking.repeats = 4;
  VispTracking other_tracking;
  other_tracking.ranges_px = {10};
  other_tracking.repeats = 4;
  other_tracking.with_scan_lines = true;
  for (int i = 0; i < kNumVideoFrames; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "image%04d.pgm", i);
    Image8 grey8 = ReadGrey8(folder / "cube" / name);
    camera = TrackWithVisp(set, cao_file, grey8, camera, tracking);
    other_camera = TrackWithVisp(set, cao_file, grey8, other_camera, other_tracking);
    if (i % kStep != 0) continue;
    cube.reference_spread_px += VertexErrorPx(set.model, camera, other_camera);
    const double distance = (camera.PositionInWorld() - ComputeBounds(set.model).Center()).norm();
    set.frames.push_back({std::move(grey8), TagFromCamera(camera, distance)});
  }
  cube.reference_spread_px /= static_cast<double>(set.frames.size());
  return cube;
}

}  // namespace groundglass
