// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {

// One image as COLMAP's database has it.
struct ColmapFileImage {
  int id = 0;
  std::string name;
  int num_columns = 6;
  std::vector<float> keypoints;  // rows of num_columns
};
struct ColmapFilePair {
  int lower_id = 0;
  int higher_id = 0;
  std::vector<uint32_t> matches;  // keypoint of the lower, of the higher, and so on
};

// Writes a database with the tables of COLMAP 3.8 that are read.
void WriteColmapFile(const std::filesystem::path& file,
                     const std::vector<ColmapFileImage>& images,
                     const std::vector<ColmapFilePair>& pairs);

// The camera of an image in it: model and parameters, and whether they are called prior knowledge.
struct ColmapFileCamera {
  int model = -1;
  bool is_prior = false;
  std::vector<double> parameters;
};
ColmapFileCamera ReadColmapFileCamera(const std::filesystem::path& file, const std::string& image);

}  // namespace groundglass
