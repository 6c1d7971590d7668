// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <optional>
#include <string>

namespace groundglass {

// What tied a scene's photographs together.
struct TieUse {
  bool patches = false;  // of faces, compared in their planes
  // Keypoints that the program COLMAP has matched.
  struct Colmap {
    std::string version;
    std::string sha256;  // of keypoints and matches as they were read
    int num_photographs = 0;
    int num_pairs = 0;   // of photographs that see the same faces
    int num_tracks = 0;  // places that two or more of them show
  };
  std::optional<Colmap> colmap = {};
};

}  // namespace groundglass
