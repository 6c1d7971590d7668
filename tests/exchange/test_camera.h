// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "exchange/exchange_scene.h"
#include "scene/view_tag.h"

#include <vector>

namespace groundglass {

// A slide whose centre lies 140 px off the middle and whose pixels are oblong: what a format gets
// wrong shows here.
inline Camera OffCentreCamera() {
  ViewTag tag;
  tag.position_in_site = {61, 93, 5.5};
  tag.lookat_in_site = {20, 15, 18};
  tag.roll_deg = 1.25;
  Camera camera = CameraFromTag(tag, 1200, 800);
  camera.focal_x_px = 1158.336;
  camera.focal_y_px = 1220.574;
  camera.center_x_px = 460.25;
  camera.center_y_px = 470.75;
  return camera;
}

// Places before it, in and around its frame.
inline std::vector<Eigen::Vector3d> PlacesBefore(const Camera& camera) {
  std::vector<Eigen::Vector3d> places;
  for (const double x : {0.0, 460.25, 777.0, 1200.0}) {
    for (const double y : {0.0, 333.0, 800.0}) {
      for (const double depth : {10.0, 95.0}) {
        const Eigen::Vector3d in_cam = depth * UnprojectToCam(camera, {x, y});
        places.push_back(Inverse(camera.cam_from_world) * in_cam);
      }
    }
  }
  return places;
}

inline ExchangeScene SceneOf(const Camera& camera) {
  ExchangeScene scene;
  scene.cameras = {{"s3", "s3.jpg", camera, {}}};
  return scene;
}

// The largest distance in the picture between what two cameras make of the same places.
inline double LargestMiss(const Camera& expected, const Camera& found) {
  double largest = 0;
  for (const Eigen::Vector3d& place : PlacesBefore(expected)) {
    const auto a = Project(expected, place);
    const auto b = Project(found, place);
    largest = std::max(largest, a && b ? (*a - *b).norm() : 1e9);
  }
  return largest;
}

}  // namespace groundglass
