// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "calibrate/board.h"
#include "scene/formats/lens.h"
#include "scene/frames.h"
#include "scene/image.h"

#include <span>
#include <string>
#include <vector>

namespace groundglass {

// A photograph of the board: 8-bit sRGB grey, one channel.
struct BoardPhotograph {
  std::string name;
  Image8 srgb_grey;
};

// What one photograph said.
struct BoardSighting {
  std::string name;
  int num_april_tags = 0;  // of the board, found and used; 0 if the photograph took no part
  double rms_px = 0;       // of its corners, each axis apart
  RigidTransform cam_from_board;
};

struct BoardResult {
  Lens lens;                               // deviations are scaled by how well the corners fit
  std::vector<BoardSighting> photographs;  // in the order given
  int num_corners = 0;
  double rms_px = 0;  // over all corners, each axis apart
  // How the photographs show the board, if not as DrawBoard draws it; one line, for a person.
  std::string layout;
  // What would make the lens better known; one line each, for a person.
  std::vector<std::string> remarks;
  // The corners miss the board, and the pictures show another one, which the last remark describes.
  bool shows_other_board = false;
};

// Finds the lens that took these photographs of a board: detects the AprilTags, measures their
// corners where the fitted black edges meet, starts from homographies (Zhang 2000), and refines the
// lens and one pose for each photograph with Ceres. Throws Error if the photographs differ in size,
// if fewer than three show the board, or if the corners do not fit it.
BoardResult CalibrateBoard(std::span<const BoardPhotograph> photographs,
                           const Board& board,
                           const BoardOptions& options = {});

}  // namespace groundglass
