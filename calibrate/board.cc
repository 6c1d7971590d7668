// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/board.h"

#include "calibrate/april_tag_detection.h"
#include "scene/check_option.h"
#include "scene/text.h"

#include <cmath>
#include <string>

namespace groundglass {

void Board::Check() const {
  CheckFromTo(columns, 2, kNumAprilTagIds, "board: columns");
  CheckFromTo(rows, 2, kNumAprilTagIds, "board: rows");
  CheckAbove(april_tag_size, 0, "board: april_tag_size");
  if (!(gap >= 0.1 * april_tag_size && gap <= april_tag_size)) {
    const bool may_be_ratio = gap >= 0.1 && gap <= 1;
    throw OptionError(
        "board: gap",
        "must be between a tenth of the tag size and the tag size; a tag needs "
        "white around it" +
            (may_be_ratio
                 ? "; if " + FormatNumber(gap) +
                       " is its ratio to the tag size, as Kalibr's tagSpacing, give --gap " +
                       FormatNumber(std::round(1e6 * gap * april_tag_size) / 1e6)
                 : ""));
  }
  CheckAtLeast(first_id, 0, "board: first_id");
  const long num_april_tags = static_cast<long>(columns) * rows;
  if (first_id + num_april_tags > kNumAprilTagIds) {
    throw OptionError("board: columns and rows and first_id:",
                      std::to_string(num_april_tags) + " tags from " + std::to_string(first_id) +
                          " on are more than the family tag36h11 has (" +
                          std::to_string(kNumAprilTagIds) + ")");
  }
}

void BoardOptions::Check() const {
  CheckFromTo(min_april_tags, 1, kNumAprilTagIds, "board: min_april_tags");
  CheckAtLeast(coarse_share, 0, "board: coarse_share");
  CheckAbove(max_rms_px, 0, "board: max_rms_px");
  CheckAbove(max_sigma_share, 0, "board: max_sigma_share");
}

Eigen::Matrix<double, 2, 4> AprilTagCornersOnBoard(const Board& board, int index) {
  const double pitch = board.april_tag_size + board.gap;
  const int stride = board.numbering.stride > 0 ? board.numbering.stride : board.columns;
  const Eigen::Vector2i place =
      board.numbering.grid_from_count * Eigen::Vector2i(index % stride, index / stride);
  const Eigen::Vector2d top_left = pitch * place.cast<double>();
  Eigen::Matrix<double, 2, 4> corners;
  corners << 0, 1, 1, 0,  //
      0, 0, 1, 1;
  corners *= board.april_tag_size;
  return corners.colwise() + top_left;
}

}  // namespace groundglass
