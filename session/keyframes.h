// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"

#include <filesystem>
#include <vector>

namespace groundglass {

// Where a film flies through: a folder of view files in natural order, as `render --path` reads it.
// Each keyframe is written when it is added. To be used by one thread.
class Keyframes {
 public:
  // Reads what is there; a folder that is not there has none. Throws Error for a damaged file.
  explicit Keyframes(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<Camera>& cameras() const { return cameras_; }

  // Writes the camera behind the others, its look-at point this far away. Throws Error if the file
  // cannot be written; then nothing is added.
  void Add(const Camera& camera, double lookat_distance);
  // Takes the last one back that was added here, and its file; false if there is none.
  bool RemoveLast();

 private:
  std::filesystem::path folder_;
  std::vector<Camera> cameras_;
  int last_number_ = 0;                       // of all files
  std::vector<std::filesystem::path> added_;  // by this object
};

}  // namespace groundglass
