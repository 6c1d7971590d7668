// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "calibrate/april_tag_detection.h"
#include "calibrate/board.h"

#include <string>
#include <vector>

namespace groundglass {

// The board as the photographs show it: border, order of the numbers and the AprilTags' turn are
// theirs, size, columns, rows and gap as given (columns and rows may be swapped). Detections with
// the other border are removed.
Board FindBoardLayout(const Board& given, std::vector<std::vector<AprilTagDetection>>& detections);

// In words, if it is not as DrawBoard draws it: "tags with a border of two cells, numbered along
// the rows from the bottom left".
std::string DescribeLayout(const Board& board);

// What the photographs show of a board that does not fit, as options to give: "the pictures show
// tags 0 to 23 in rows of 6, with a gap of 0.25 of the tag: --columns 6 ...". Empty if they do not
// tell.
std::string DescribeSeenBoard(const Board& given,
                              const std::vector<std::vector<AprilTagDetection>>& detections);

}  // namespace groundglass
