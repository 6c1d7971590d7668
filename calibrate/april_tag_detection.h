// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace groundglass {

// One AprilTag of the family tag36h11 in a photograph: the image points (pixels) of its black
// square's corners, in the AprilTag's own order: top left, top right, bottom right, bottom left.
struct AprilTagDetection {
  int id = 0;
  int border_cells = 1;  // of its black border: 2 on Kalibr's boards
  Eigen::Matrix<double, 2, 4> corners_px;
};

// How small an AprilTag may be: about 25 px at full size, or a fiftieth of the picture's width,
// which takes a quarter of the time in a photograph of 12 megapixels.
enum class AprilTagDetail { kFine, kCoarse };

// Whether the two differ for pictures of this width.
bool HasCoarseDetail(int width_px);

// Finds AprilTags with borders of one and two cells in 8-bit sRGB grey, sorted by id. An id that is
// seen twice is left out, since nobody can tell which one is meant. Corners are good to a few
// tenths of a pixel.
std::vector<AprilTagDetection> DetectAprilTags(const Image8& srgb_grey,
                                               AprilTagDetail detail = AprilTagDetail::kFine);

// What else there is to see where DetectAprilTags finds nothing, as the end of a sentence:
// AprilTags of another family, a mirrored or a negative picture; else that there are no AprilTags.
std::string DescribeOtherAprilTags(const Image8& srgb_grey);

// An AprilTag's 8 x 8 cells, black border included: true is white. Throws Error beyond the family's
// end.
constexpr int kAprilTagCells = 8;
constexpr int kNumAprilTagIds = 587;
using AprilTagPattern = Eigen::Matrix<bool, kAprilTagCells, kAprilTagCells>;  // (row, column)
AprilTagPattern GetAprilTagPattern(int id);

}  // namespace groundglass
