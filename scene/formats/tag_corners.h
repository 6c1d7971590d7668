// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <Eigen/Dense>

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// A corner of an AprilTag's black square, in a photograph and where it was surveyed.
struct SeenTagCorner {
  std::string photograph;
  int april_tag = 0;  // its id
  int corner = 0;     // from 0: top left, top right, bottom right, bottom left
  Eigen::Vector2d image_px = Eigen::Vector2d::Zero();
  double sigma_px = 0;  // one standard deviation each way, of finding it in the picture
  Eigen::Vector3d surveyed_in_world = Eigen::Vector3d::Zero();
  // Of the whole tag's place along each axis, one standard deviation; model's unit.
  double survey_sigma = 0;
};

// The file in calibration/ that `calibrate tags` writes (docs/calibration.md).
constexpr const char* kTagCornersFile = "apriltag-corners.csv";

// Reads it: columns photograph, id, corner (1 to 4), x_px, y_px, sigma_px, x, y, z (`site`), sigma.
// Throws Error naming file and line.
std::vector<SeenTagCorner> ReadTagCorners(const std::filesystem::path& file);
std::string FormatTagCorners(const std::vector<SeenTagCorner>& corners);

// "34 corners of 8 AprilTags".
std::string CountTagCorners(const std::vector<SeenTagCorner>& corners);

}  // namespace groundglass
