// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

struct NamedCamera {
  std::string name;  // the image's file name, "s5.jpg"
  Camera camera;
};

// COLMAP text model (cameras.txt, images.txt, points3D.txt) in `world`: one OPENCV camera for each
// image, pixel centres at 0.5 as ours, numbered by the byte order of the names as COLMAP's
// database of the same images is. The folder is made; points3D.txt is left empty.
void WriteColmapModel(const std::filesystem::path& folder, const std::vector<NamedCamera>& cameras);

// Reads SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL and OPENCV without tangential terms; in the
// order of images.txt. Throws Error naming file and line.
std::vector<NamedCamera> ReadColmapModel(const std::filesystem::path& folder);

}  // namespace groundglass
