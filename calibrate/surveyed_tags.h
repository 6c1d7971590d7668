// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"

#include <Eigen/Dense>

#include <filesystem>
#include <vector>

namespace groundglass {

// An AprilTag (tag36h11) that is fixed in the scene at a place that was surveyed.
struct SurveyedTag {
  int id = 0;
  // Its black square's corners, in the AprilTag's own order (april_tag_detection.h).
  Eigen::Matrix<double, 3, 4> corners_in_world = Eigen::Matrix<double, 3, 4>::Zero();
  double sigma = 0;  // of its place along each axis, one standard deviation; model's unit
};

// Reads apriltags.csv (docs/calibration.md), a table as scene/formats/csv.h has it: `id`, and
// either `x,y,z` (the middle), `nx,ny,nz` (the way it faces) and `size` (of the black square), the
// tag standing upright, or the four corners `x1,y1,z1` to `x4,y4,z4`; `sigma` may follow. In
// `site`, model's unit; a sigma that nobody gives is 0.01 m. Throws Error with every fault, one
// line each, naming file and line.
std::vector<SurveyedTag> ReadSurveyedTags(const std::filesystem::path& file, LengthUnit unit);

}  // namespace groundglass
