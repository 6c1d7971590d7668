// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/ties/covisible_pairs.h"
#include "register/ties/feature_tracks.h"
#include "register/ties/tie_picture.h"
#include "scene/camera.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {

struct ColmapOptions {
  std::string program = "colmap";  // a bare name is sought in PATH
  // Where database.db is kept, and used again as long as photographs and options are the same; a
  // temporary folder if empty.
  std::filesystem::path folder;
  int max_keypoints = 8192;  // of a photograph
  // Which photographs are compared.
  CovisibleOptions pairs;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "colmap options: ") const;
};

// A photograph as COLMAP is to see it.
struct ColmapPhotograph {
  const TiePicture* picture = nullptr;
  Camera camera;  // for the picture's size
};

struct ColmapMatches {
  FeatureMatches matches;
  std::string version;  // of the program: "3.8"
  // SHA-256 of keypoints and matches as they were read: the bytes of the database may differ from
  // run to run though what it says does not.
  std::string sha256;
};

// The program's version: "3.8"; "unknown" if it does not say. Error if it is missing or cannot be
// started, with what to install.
std::string FindColmapVersion(const ColmapOptions& options);

// SIFT keypoints of the photographs, and for each of the pairs what of them shows the same, as
// COLMAP (Schoenberger and Frahm, CVPR 2016) finds and verifies it with these cameras' lenses. The
// program gets copies of the pictures at the size at which they are registered, and their masks.
// Its search draws random numbers anew each time (3.8), so the same pictures give other matches
// than before unless the database in options.folder is kept: then they give the same. Error in one
// line if the program is missing or fails, or this one was built without SQLite.
ColmapMatches MatchWithColmap(const std::vector<ColmapPhotograph>& photographs,
                              const std::vector<std::pair<int, int>>& pairs,
                              const ColmapOptions& options);

}  // namespace groundglass
