// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/ties/feature_tracks.h"
#include "scene/camera.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace groundglass {

// COLMAP's database of keypoints and matches (https://colmap.github.io/database.html): SQLite, as
// its releases from 3.0 on write it. Images are called by name. All functions throw Error naming
// the file; also where this program was built without SQLite.
class ColmapDatabase {
 public:
  // Opens one that is there.
  explicit ColmapDatabase(const std::filesystem::path& file);
  ~ColmapDatabase();
  ColmapDatabase(const ColmapDatabase&) = delete;
  ColmapDatabase& operator=(const ColmapDatabase&) = delete;

  // What is written down beside COLMAP's own tables, in one of ours; empty if nothing is.
  std::string Note(const std::string& name) const;
  void SetNote(const std::string& name, const std::string& text);

  // The lens of an image (OPENCV, or FULL_OPENCV with k3), which its matches are verified with.
  void SetCamera(const std::string& image, const Camera& camera);
  // Pairs of images can then be matched anew.
  void ForgetMatches();

  // Keypoints of these images, in this order, and the verified matches between them by their
  // numbers here, in order.
  FeatureMatches ReadMatches(const std::vector<std::string>& images) const;

  // Whether this program can read databases at all.
  static bool IsAvailable();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace groundglass
