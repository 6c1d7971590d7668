// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"

#include <filesystem>
#include <string>
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
  // cannot be written, or if a name that is no number would still come after it; then nothing is
  // added. A file that has come there meanwhile is let be.
  void Add(const Camera& camera, double lookat_distance);
  // Takes the last one back that was added here, and its file; false if there is none. Throws
  // Error if the file was changed since, or cannot be removed; it stays, and is forgotten here.
  bool RemoveLast();

 private:
  std::filesystem::path folder_;
  std::vector<Camera> cameras_;
  int last_number_ = 0;    // of all files
  std::string last_stem_;  // of those that were there
  struct Added {
    std::filesystem::path file;
    std::string text;
    size_t camera = 0;  // its place in cameras_
  };
  std::vector<Added> added_;  // by this object
};

}  // namespace groundglass
