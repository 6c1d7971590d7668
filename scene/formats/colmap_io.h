// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

struct NamedCamera {
  std::string name;  // the image's path below the folder of images: "s5.jpg", "north/0001.jpg"
  Camera camera;
};

// COLMAP text model (cameras.txt, images.txt, points3D.txt) in `world`: one camera for each image
// (OPENCV, or FULL_OPENCV where k3 is not 0), pixel centres at 0.5 as ours, numbered by the byte
// order of the names as COLMAP's database of the same images is. The folder is made; points3D.txt
// is left empty.
void WriteColmapModel(const std::filesystem::path& folder, const std::vector<NamedCamera>& cameras);

// Where a COLMAP model lies.
struct ColmapFiles {
  std::filesystem::path cameras_file;  // cameras.txt or .bin
  std::filesystem::path images_file;
  std::vector<std::string> warnings;
};
// The model in this folder, or in its sparse/, 0/ or sparse/0/, text before binary; nothing if
// there is none. Throws Error if it cannot be told which one is meant, or half of it is missing.
std::optional<ColmapFiles> FindColmapModel(const std::filesystem::path& folder);

// What is wrong with one image of a model, or with one line of its files.
struct ColmapFault {
  std::string name;  // of the image; empty if the line does not say
  std::string text;  // for a person, with file and line
};
struct ColmapReading {
  std::vector<NamedCamera> cameras;
  std::vector<ColmapFault> faults;  // of images that are left out
};
// Text and binary models: SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, and FULL_OPENCV
// with k4 = k5 = k6 = 0; in the order of the file of images, points not looked at. Backslashes in
// names, which COLMAP writes on Windows, become slashes. Throws Error naming file and line where no
// image can be read.
ColmapReading ReadColmapImages(const ColmapFiles& files);
// Warnings for a person: the first few faults, and how many more there are.
std::vector<std::string> TellColmapFaults(const std::vector<ColmapFault>& faults);

// The same of models that have to be whole: throws the first fault.
std::vector<NamedCamera> ReadColmapModel(const ColmapFiles& files);
std::vector<NamedCamera> ReadColmapModel(const std::filesystem::path& folder);

}  // namespace groundglass
