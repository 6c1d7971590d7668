// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"

#include <Eigen/Dense>

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// What both of COLMAP's formats say, before it is judged. A place is "FILE:LINE", or "FILE: image
// 7" in a binary file, for messages.
struct ColmapCamera {
  Camera camera;      // without a pose
  std::string fault;  // why it is no camera of ours; told if an image uses it
};
struct ColmapImage {
  std::string place;
  std::string name;
  std::array<double, 7> pose = {};  // QW QX QY QZ TX TY TZ
  long long camera_id = 0;
  std::string fault;  // why it cannot be used
};
struct ColmapRecords {
  std::map<long long, ColmapCamera> cameras;
  std::vector<ColmapImage> images;
  std::vector<std::string> stray_faults;  // of lines that belong to no camera or image
};

// A model of cameras that COLMAP has.
struct ColmapCameraKind {
  int id;
  std::string_view name;
  int num_parameters;
  // Where our numbers are among its parameters, -1 for none.
  int focal_x, focal_y, center_x, center_y, k1, k2, p1, p2, k3;
};
const ColmapCameraKind* FindColmapCameraKind(std::string_view name);
const ColmapCameraKind* FindColmapCameraKind(int id);

// `folder` is the model's, for the command that a fault names. Throws Error for numbers that are
// none of any camera.
ColmapCamera MakeColmapCamera(const ColmapCameraKind& kind,
                              long long width,
                              long long height,
                              const std::vector<double>& parameters,
                              const std::string& place,
                              const std::filesystem::path& folder);
// One of a kind that is not read at all.
ColmapCamera UnreadColmapCamera(const std::string& kind,
                                const std::string& place,
                                const std::filesystem::path& folder);

ColmapRecords ReadColmapText(const std::filesystem::path& cameras_file,
                             const std::filesystem::path& images_file);
ColmapRecords ReadColmapBinary(const std::filesystem::path& cameras_file,
                               const std::filesystem::path& images_file);

}  // namespace groundglass
