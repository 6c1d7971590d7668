// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <filesystem>

namespace groundglass {

// Which AprilTag of a board has which number. That of number first_id + i stands at this place of
// the grid, in steps of one AprilTag from the first, in the AprilTags' own directions (x right, y
// down):
//   grid_from_count * (i % stride, i / stride)
struct BoardNumbering {
  int stride = 0;  // AprilTags before the next row begins; 0: as many as the board has columns
  Eigen::Matrix2i grid_from_count = Eigen::Matrix2i::Identity();
};

// A flat grid of AprilTags of the family tag36h11 (Olson 2011), as DrawBoard draws it numbered row
// by row from the top left. Lengths are in any one unit: a lens does not depend on it. Boards that
// are numbered in another order, or whose AprilTags are turned (OpenCV's) or have a border of two
// cells and squares between them (Kalibr's), are told by their photographs. The board's frame is
// the first AprilTag's: x right, y down, z into the board; its origin is that AprilTag's top-left
// black corner.
struct Board {
  int columns = 6;
  int rows = 4;
  double april_tag_size = 1;  // edge of an AprilTag's black square
  double gap = 0.25;          // white between neighbouring black squares
  int first_id = 0;           // the lowest number; the family has 587
  int border_cells = 1;       // of an AprilTag's black border; 2 is Kalibr's
  BoardNumbering numbering;

  void Check() const;  // throws Error naming the first field out of range
};

// The four black corners of a board's AprilTag: top left, top right, bottom right, bottom left.
// `index` counts from 0 in the order of the numbers.
Eigen::Matrix<double, 2, 4> AprilTagCornersOnBoard(const Board& board, int index);

// The board as a picture to print: black 0, white 255, one channel, a white margin and a line
// below that says what to measure after printing.
Image8 DrawBoard(const Board& board);

// Of CalibrateBoard.
struct BoardOptions {
  // Free the second distortion coefficient as well: for wide lenses, with the board seen up to
  // the frame's corners.
  bool refine_k2 = false;

  // A photograph takes part if it shows at least this many of the board's AprilTags.
  int min_april_tags = 4;

  // A large photograph is looked at at full size only where fewer of the board's AprilTags than
  // this share are found at low resolution.
  double coarse_share = 0.4;

  // The corners must fit the board this well, else its description or its flatness is at fault.
  // Pixels.
  double max_rms_px = 2.0;

  // A view angle of which this share is its standard deviation is not known at all.
  double max_sigma_share = 0.25;

  void Check() const;
};

// Reads Kalibr's target file (target_type: aprilgrid, tagCols, tagRows, tagSize, tagSpacing), whose
// tagSpacing is the gap as a share of the AprilTag. Throws Error naming file and line.
Board ReadKalibrTarget(const std::filesystem::path& file);

}  // namespace groundglass
