// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/formats/scene_folder.h"
#include "scene/polygon_model.h"

#include <string>
#include <vector>

namespace groundglass {

// Whether cameras that another program found are in the model's frame: how many of them see the
// front of some face in a fiftieth of their frame.
struct PoseCheck {
  int num_cameras = 0;
  int num_seeing = 0;
  // Where hardly any does: what is wrong with the poses if they would see the model once it is
  // undone (camera to world in place of world to camera, positions in place of translations,
  // quaternions with w last, axes of OpenGL), else what else it may be. Empty: nothing.
  std::string fault;
};
PoseCheck CheckPoses(const PolygonModel& model, const std::vector<Camera>& cameras);

// Throws Error with that fault if a COLMAP model gave the scene's cameras.
void RequireSoundPoses(const Scene& scene);

}  // namespace groundglass
