// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/board_layout.h"

#include "calibrate/board_solve.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace groundglass {
namespace {

// Photographs that are asked at most: those with the most AprilTags.
constexpr size_t kMostPhotographs = 4;
// A board's own distortion-free fit lies below this share of an AprilTag's side.
constexpr double kGoodMisfit = 0.08;
// A lens with strong distortion or a gap measured wrongly reaches this; a wrong order is far
// beyond.
constexpr double kPlausibleMisfit = 0.3;

using Detections = std::vector<std::vector<AprilTagDetection>>;

// The eight ways to lay the count along the AprilTags' right and down.
std::array<Eigen::Matrix2i, 8> AllGrids() {
  std::array<Eigen::Matrix2i, 8> grids;
  for (int i = 0; i < 8; ++i) {
    const int x = (i & 1) != 0 ? -1 : 1;
    const int y = (i & 2) != 0 ? -1 : 1;
    grids[i] << x, 0, 0, y;
    if ((i & 4) != 0) grids[i] << 0, y, x, 0;
  }
  return grids;
}

std::vector<BoardShot> MakeShots(const Board& board, const Detections& detections) {
  std::vector<BoardShot> shots;
  for (const std::vector<AprilTagDetection>& april_tags : detections) {
    BoardShot& shot = shots.emplace_back();
    for (const AprilTagDetection& detection : april_tags) {
      const int index = detection.id - board.first_id;
      if (index < 0 || index >= board.columns * board.rows) continue;
      AprilTagCorners& april_tag = shot.april_tags.emplace_back();
      april_tag.id = index;
      april_tag.corners_px =
          Eigen::Map<const Eigen::Matrix<double, 8, 1>>(detection.corners_px.data());
    }
  }
  std::erase_if(shots, [](const BoardShot& shot) { return shot.april_tags.size() < 3; });
  std::stable_sort(shots.begin(), shots.end(), [](const BoardShot& a, const BoardShot& b) {
    return a.april_tags.size() > b.april_tags.size();
  });
  if (shots.size() > kMostPhotographs) shots.resize(kMostPhotographs);
  return shots;
}

// How far the corners lie from a flat board without distortion, as a share of the AprilTags' sides,
// on average over the photographs.
double Misfit(const Board& board, const std::vector<BoardShot>& shots) {
  double sum = 0;
  for (const BoardShot& shot : shots) {
    Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
    double side_px = 0;
    for (const AprilTagCorners& april_tag : shot.april_tags) {
      center_px += april_tag.corners_px.head<2>() / static_cast<double>(shot.april_tags.size());
      side_px += (april_tag.corners_px.head<2>() - april_tag.corners_px.segment<2>(4)).norm() /
                 std::sqrt(2.0) / static_cast<double>(shot.april_tags.size());
    }
    double spread_px = side_px;
    for (const AprilTagCorners& april_tag : shot.april_tags) {
      spread_px = std::max(spread_px, (april_tag.corners_px.head<2>() - center_px).norm());
    }
    const Eigen::Matrix3d homography = EstimateHomography(board, shot, center_px, spread_px);
    double squared_px = 0;
    for (const AprilTagCorners& april_tag : shot.april_tags) {
      const Eigen::Matrix<double, 2, 4> on_board = AprilTagCornersOnBoard(board, april_tag.id);
      for (int corner = 0; corner < 4; ++corner) {
        const Eigen::Vector3d seen = homography * on_board.col(corner).homogeneous();
        squared_px += (seen.hnormalized() + center_px - april_tag.corners_px.segment<2>(2 * corner))
                          .squaredNorm();
      }
    }
    sum += std::sqrt(squared_px / (4.0 * static_cast<double>(shot.april_tags.size()))) / side_px;
  }
  return sum / static_cast<double>(shots.size());
}

// The numbering among these strides that fits best, and how well.
double FitNumbering(const std::vector<int>& strides,
                    const std::vector<BoardShot>& shots,
                    Board& board) {
  BoardNumbering best = board.numbering;
  double least = std::numeric_limits<double>::infinity();
  for (const int stride : strides) {
    for (const Eigen::Matrix2i& grid : AllGrids()) {
      board.numbering = {stride, grid};
      const double misfit = Misfit(board, shots);
      // Where few AprilTags are seen several fit alike: then the first, which is the usual one.
      if (misfit < 0.5 * least) {
        least = misfit;
        best = board.numbering;
      }
    }
  }
  board.numbering = best;
  return least;
}

}  // namespace

Board FindBoardLayout(const Board& given, Detections& detections) {
  size_t num_narrow = 0;
  size_t num_wide = 0;
  for (const std::vector<AprilTagDetection>& april_tags : detections) {
    for (const AprilTagDetection& april_tag : april_tags) {
      (april_tag.border_cells == 1 ? num_narrow : num_wide) += 1;
    }
  }
  Board board = given;
  board.border_cells = num_wide > num_narrow ? 2 : 1;
  for (std::vector<AprilTagDetection>& april_tags : detections) {
    std::erase_if(april_tags, [&](const auto& april_tag) {
      return april_tag.border_cells != board.border_cells;
    });
  }
  const std::vector<BoardShot> shots = MakeShots(board, detections);
  if (shots.empty()) return board;
  if (FitNumbering({board.columns, board.rows}, shots, board) > kPlausibleMisfit) {
    board.numbering = given.numbering;  // for whoever says what is wrong
  }
  return board;
}

std::string DescribeLayout(const Board& board) {
  const Eigen::Matrix2i& grid = board.numbering.grid_from_count;
  const bool is_usual = grid == Eigen::Matrix2i::Identity();
  const bool is_swapped = board.numbering.stride != 0 && board.numbering.stride != board.columns;
  std::string text;
  if (board.border_cells == 2) text += "tags with a border of two cells, as Kalibr draws them";
  if (!is_usual || is_swapped) {
    const Eigen::Vector2i first_step = grid.col(0);
    const Eigen::Vector2i next_row = grid.col(1);
    const int right = first_step.x() + next_row.x();
    const int down = first_step.y() + next_row.y();
    text += std::string(text.empty() ? "tags" : ";") + " numbered along the " +
            (first_step.x() != 0 ? "rows" : "columns") + " from the " +
            (down > 0 ? "top " : "bottom ") + (right > 0 ? "left" : "right") +
            " (as the tags stand), " + std::to_string(board.numbering.stride) + " at a time";
  }
  return text;
}

std::string DescribeSeenBoard(const Board& given, const Detections& detections) {
  int first = std::numeric_limits<int>::max();
  int last = -1;
  for (const std::vector<AprilTagDetection>& april_tags : detections) {
    for (const AprilTagDetection& april_tag : april_tags) {
      first = std::min(first, april_tag.id);
      last = std::max(last, april_tag.id);
    }
  }
  if (last < 0) return "";
  const int count = last - first + 1;
  std::string text = "the pictures show tags " + std::to_string(first) + " to " +
                     std::to_string(last) + " of tag36h11";
  // Any grid that holds them, as one long row for the sake of their numbers.
  Board seen = given;
  seen.first_id = first;
  seen.columns = count;
  seen.rows = 1;
  const std::vector<BoardShot> shots = MakeShots(seen, detections);
  if (shots.empty()) return text;
  double least = std::numeric_limits<double>::infinity();
  Board best = seen;
  std::vector<int> strides;
  for (int stride = 2; stride <= std::min(count, 40); ++stride) strides.push_back(stride);
  for (double share = 0.1; share < 1.01; share += 0.05) {
    seen.gap = share * seen.april_tag_size;
    const double misfit = FitNumbering(strides, shots, seen);
    if (misfit < least) {
      least = misfit;
      best = seen;
    }
  }
  if (least > kGoodMisfit) return text;
  // The gap between two of the steps tried.
  for (double share = best.gap / best.april_tag_size - 0.045; share < 1.06; share += 0.005) {
    if (share > best.gap / best.april_tag_size + 0.05) break;
    seen = best;
    seen.gap = share * seen.april_tag_size;
    const double misfit = Misfit(seen, shots);
    if (misfit < least) {
      least = misfit;
      best = seen;
    }
  }
  const int stride = best.numbering.stride;
  const double share = std::round(100 * best.gap / best.april_tag_size) / 100;
  return text + " in rows of " + std::to_string(stride) + ", with a gap of " + FormatNumber(share) +
         " of the tag's size: --columns " + std::to_string(stride) + " --rows " +
         std::to_string((count + stride - 1) / stride) + " --first-id " + std::to_string(first) +
         " --tag-size " + FormatNumber(given.april_tag_size) + " --gap " +
         FormatNumber(std::round(1000 * share * given.april_tag_size) / 1000);
}

}  // namespace groundglass
