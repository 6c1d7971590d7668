// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// A photograph and the camera that took it.
struct BakePhotograph {
  std::string name;  // the stem: "s5"
  std::filesystem::path image_file;
  Camera camera;
  double weight = 1;  // below 1: used where no other is nearly as good (verdict `review`)
  std::optional<std::filesystem::path> mask_file;   // white = ignore
  std::optional<std::filesystem::path> faces_file;  // hand-painted, in place of the automatic mask
  // The faces (from 0) that it may texture; nothing: all of them.
  std::optional<std::vector<int>> faces;
};

// Gets the face mask of a photograph, with the faces' numbers in the model's file.
using FaceMaskObserver = std::function<void(const BakePhotograph&, const Image16& numbers)>;

}  // namespace groundglass
