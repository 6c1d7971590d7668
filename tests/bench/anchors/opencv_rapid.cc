// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/bench/anchors/trackers.h"

#ifdef GROUNDGLASS_HAS_RAPID
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/rapid.hpp>
#endif

namespace groundglass {

#ifdef GROUNDGLASS_HAS_RAPID
namespace {

Method::Found Track(const AnchorSet& set,
                    const PerturbedStart& start,
                    const std::vector<int>& ranges_px) {
  const Image8& grey8 = set.frames[start.frame].grey8;
  const cv::Mat grey(grey8.height, grey8.width, CV_8UC1, const_cast<uint8_t*>(grey8.values.data()));
  cv::Mat picture;
  cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
  const Camera camera = CameraFromTag(start.tag, grey8.width, grey8.height);
  Method::Found found{camera};

  std::vector<cv::Point3f> points;
  for (const Eigen::Vector3d& point : set.model.points_in_world) {
    points.emplace_back(static_cast<float>(point.x()),
                        static_cast<float>(point.y()),
                        static_cast<float>(point.z()));
  }
  std::vector<cv::Vec3i> triangles;
  for (int face = 0; face < static_cast<int>(set.model.faces.size()); ++face) {
    for (const std::array<int, 3>& t : TriangulateFace(set.model, face)) {
      triangles.emplace_back(t[0], t[1], t[2]);
    }
  }
  // OpenCV counts pixel centres from 0.
  const cv::Matx33d intrinsics(camera.focal_x_px,
                               0,
                               camera.center_x_px - 0.5,
                               0,
                               camera.focal_y_px,
                               camera.center_y_px - 0.5,
                               0,
                               0,
                               1);
  cv::Matx33d rotation;
  cv::Vec3d translation;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      rotation(row, column) = camera.cam_from_world.rotation(row, column);
    }
    translation[row] = camera.cam_from_world.translation[row];
  }
  cv::Vec3d turn;
  cv::Rodrigues(rotation, turn);
  try {
    const auto tracker = cv::rapid::Rapid::create(points, triangles);
    for (const int range_px : ranges_px) {
      tracker->compute(picture,
                       100,
                       range_px,
                       intrinsics,
                       turn,
                       translation,
                       cv::TermCriteria(cv::TermCriteria::MAX_ITER, 10, 0));
    }
    cv::Rodrigues(turn, rotation);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        found.camera.cam_from_world.rotation(row, column) = rotation(row, column);
      }
      found.camera.cam_from_world.translation[row] = translation[row];
    }
  } catch (const cv::Exception&) {
    // It found too few points: the start stands.
  }
  return found;
}

}  // namespace

std::vector<Method> OpenCvMethods(const AnchorSet& set) {
  std::vector<Method> methods;
  for (const auto& [setting, ranges_px] :
       {std::pair<std::string, std::vector<int>>("rapid, range 10", {10}),
        {"rapid, range 20", {20}},
        {"rapid, range 40", {40}},
        {"rapid, range 60, 30, 15, 7", {60, 30, 15, 7}}}) {
    methods.push_back(
        {"OpenCV", setting, [&set, ranges_px = ranges_px](const PerturbedStart& start) {
           return Track(set, start, ranges_px);
         }});
  }
  return methods;
}
#else
std::vector<Method> OpenCvMethods(const AnchorSet&) { return {}; }
#endif

}  // namespace groundglass
