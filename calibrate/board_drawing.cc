// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/april_tag_detection.h"
#include "calibrate/board.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace groundglass {
namespace {

// An AprilTag's cell is about this wide (pixels): fine enough for any printer.
constexpr int kMinCellPx = 32;
constexpr int kMaxCellPx = 64;

// The cell size for which the gap comes closest to whole pixels.
int ChooseCellPx(const Board& board) {
  int best_px = kMinCellPx;
  double best_error = 1;
  for (int cell_px = kMinCellPx; cell_px <= kMaxCellPx; ++cell_px) {
    const double gap_px = board.gap / board.april_tag_size * kAprilTagCells * cell_px;
    const double error = std::abs(gap_px - std::round(gap_px)) / gap_px;
    if (error < best_error - 1e-9) {
      best_error = error;
      best_px = cell_px;
    }
  }
  return best_px;
}

}  // namespace

Image8 DrawBoard(const Board& board) {
  board.Check();
  const int cell_px = ChooseCellPx(board);
  const int april_tag_px = kAprilTagCells * cell_px;
  const int gap_px = static_cast<int>(std::lround(board.gap / board.april_tag_size * april_tag_px));
  const int margin_px = std::max(gap_px, 2 * cell_px);
  const int width_px = 2 * margin_px + board.columns * (april_tag_px + gap_px) - gap_px;
  const int height_px = 2 * margin_px + board.rows * (april_tag_px + gap_px) - gap_px;
  Image8 picture(width_px, height_px + 2 * cell_px, 1, 255);
  for (int index = 0; index < board.columns * board.rows; ++index) {
    const AprilTagPattern is_white = GetAprilTagPattern(board.first_id + index);
    const int left = margin_px + index % board.columns * (april_tag_px + gap_px);
    const int top = margin_px + index / board.columns * (april_tag_px + gap_px);
    for (int y = 0; y < april_tag_px; ++y) {
      for (int x = 0; x < april_tag_px; ++x) {
        if (!is_white(y / cell_px, x / cell_px)) *picture.At(left + x, top + y) = 0;
      }
    }
  }
  const std::string caption =
      "tag36h11, " + std::to_string(board.columns) + " columns, " + std::to_string(board.rows) +
      " rows, from tag " + std::to_string(board.first_id) +
      ". Mount it flat; measure a black square's edge (tag size) and the white between two (gap).";
  // As large as fits between the margins.
  int baseline = 0;
  const cv::Size at_scale_one = cv::getTextSize(caption, cv::FONT_HERSHEY_SIMPLEX, 1, 1, &baseline);
  const double scale = std::min(static_cast<double>(width_px - 2 * margin_px) / at_scale_one.width,
                                static_cast<double>(cell_px) / at_scale_one.height);
  cv::Mat view(picture.height, picture.width, CV_8UC1, picture.values.data());
  cv::putText(view,
              caption,
              {margin_px, height_px + cell_px / 2},
              cv::FONT_HERSHEY_SIMPLEX,
              scale,
              cv::Scalar(0),
              std::max(1, static_cast<int>(std::lround(2 * scale))),
              cv::LINE_AA);
  return picture;
}

}  // namespace groundglass
