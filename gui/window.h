// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/model_io.h"

#include <filesystem>

namespace groundglass {

struct WindowOptions {
  std::filesystem::path folder;  // a scene, an output folder, or a model file
  std::filesystem::path
      scene_folder;  // where the photographs of an output folder are; may be empty
  ModelOptions model;
  int width_px = 1500;
  int height_px = 1000;
  double text_scale = 1;
  // Where a line of JSON is written for each press of the Pause key, once all that was asked for
  // before it is done and drawn: what tests wait for. Nowhere if empty.
  std::filesystem::path test_log;

  void Check() const;  // throws Error naming the first field out of range
};

// Opens the window and returns when it is closed. Throws Error if there is no display, or nothing
// to show.
void RunWindow(const WindowOptions& options);

}  // namespace groundglass
