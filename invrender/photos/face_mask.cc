// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/photos/face_mask.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

constexpr int kTilePx = 8;
constexpr int kQuarterPx = kTilePx / 2;
constexpr int kBlockTiles = 4;  // along a side of a block

bool AreCornersAlike(const Image16& corners, int column, int row) {
  const uint16_t* top = corners.At(column, row);
  const uint16_t* bottom = corners.At(column, row + 1);
  return top[0] == top[1] && top[0] == bottom[0] && top[0] == bottom[1];
}

// Quarters of tiles (kQuarterPx squared) that some projected edge of the model touches.
class TouchedQuarters {
 public:
  explicit TouchedQuarters(const Camera& camera)
      : camera_(camera),
        columns_((camera.width_px + kTilePx - 1) / kTilePx * 2),
        rows_((camera.height_px + kTilePx - 1) / kTilePx * 2),
        touched_(static_cast<size_t>(columns_) * rows_, 0) {}

  int tile_columns() const { return columns_ / 2; }
  int tile_rows() const { return rows_ / 2; }
  bool IsTouched(int column, int row) const {
    return touched_[static_cast<size_t>(row) * columns_ + column] != 0;
  }
  bool IsTileTouched(int column, int row) const {
    return IsTouched(2 * column, 2 * row) || IsTouched(2 * column + 1, 2 * row) ||
           IsTouched(2 * column, 2 * row + 1) || IsTouched(2 * column + 1, 2 * row + 1);
  }

  bool IsBlockTouched(int column, int row) const {
    for (int j = row * kBlockTiles; j < std::min((row + 1) * kBlockTiles, tile_rows()); ++j) {
      for (int i = column * kBlockTiles; i < std::min((column + 1) * kBlockTiles, tile_columns());
           ++i) {
        if (IsTileTouched(i, j)) return true;
      }
    }
    return false;
  }

  // Halves the edge until its projection is short, so that distortion bends it as it should.
  void TouchEdge(const Eigen::Vector3d& start_in_cam,
                 const Eigen::Vector3d& end_in_cam,
                 int depth) {
    if (start_in_cam.z() <= 0 && end_in_cam.z() <= 0) return;
    const auto start_px = ProjectFromCam(camera_, start_in_cam);
    const auto end_px = ProjectFromCam(camera_, end_in_cam);
    if (start_px && end_px) {
      const double length = (*end_px - *start_px).norm();
      const double margin = 4 + length / 4;
      const Eigen::Vector2d low = start_px->cwiseMin(*end_px);
      const Eigen::Vector2d high = start_px->cwiseMax(*end_px);
      if (high.x() < -margin || high.y() < -margin || low.x() > camera_.width_px + margin ||
          low.y() > camera_.height_px + margin) {
        return;
      }
      if (length <= kTilePx) {
        // So short a piece is straight.
        const Eigen::Vector2d middle = (*start_px + *end_px) / 2;
        Touch(start_px->cwiseMin(middle), start_px->cwiseMax(middle));
        Touch(end_px->cwiseMin(middle), end_px->cwiseMax(middle));
        return;
      }
    }
    if (depth == 0) {
      if (start_px) Touch(*start_px, *start_px);
      if (end_px) Touch(*end_px, *end_px);
      return;
    }
    const Eigen::Vector3d middle = (start_in_cam + end_in_cam) / 2;
    TouchEdge(start_in_cam, middle, depth - 1);
    TouchEdge(middle, end_in_cam, depth - 1);
  }

 private:
  void Touch(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
    const auto tile = [](double px, int count) {
      return static_cast<int>(
          std::clamp(std::floor(px / kQuarterPx), -1.0, static_cast<double>(count)));
    };
    const int x0 = std::max(0, tile(low.x() - 1, columns_));
    const int y0 = std::max(0, tile(low.y() - 1, rows_));
    const int x1 = std::min(columns_ - 1, tile(high.x() + 1, columns_));
    const int y1 = std::min(rows_ - 1, tile(high.y() + 1, rows_));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) touched_[static_cast<size_t>(y) * columns_ + x] = 1;
    }
  }

  const Camera& camera_;
  int columns_;
  int rows_;
  std::vector<char> touched_;
};

// Labels by as few rays as tell. Where faces cut through one another (a chimney sunk into a roof)
// the answer changes without an edge, along a straight line: the corners of a block, a tile or a
// quarter on its two sides tell.
class FaceMaskMaker {
 public:
  FaceMaskMaker(const Visibility& visibility, const Camera& camera, const TouchedQuarters& touched)
      : visibility_(visibility),
        camera_(camera),
        touched_(touched),
        position_in_world_(camera.PositionInWorld()) {}

  Image16 Make() {
    LookAtBlocks();
    LookAtTiles();
    labels_ = Image16(camera_.width_px, camera_.height_px, 1);
    tbb::parallel_for(0, touched_.tile_rows(), [&](int row) {
      for (int column = 0; column < touched_.tile_columns(); ++column) FillTile(column, row);
    });
    return std::move(labels_);
  }

 private:
  uint16_t LabelAt(double x, double y) const {
    const auto hit = visibility_.FirstHit(position_in_world_, UnprojectToWorld(camera_, {x, y}));
    return static_cast<uint16_t>(hit && hit->is_front ? hit->face + 1 : 0);
  }
  uint16_t CornerLabel(int x, int y) const {
    return LabelAt(std::min(x, camera_.width_px), std::min(y, camera_.height_px));
  }

  // The corners of all blocks, and which blocks these and the edges leave uniform.
  void LookAtBlocks() {
    const int columns = (touched_.tile_columns() + kBlockTiles - 1) / kBlockTiles;
    const int rows = (touched_.tile_rows() + kBlockTiles - 1) / kBlockTiles;
    block_corners_ = Image16(columns + 1, rows + 1, 1);
    tbb::parallel_for(0, rows + 1, [&](int row) {
      for (int column = 0; column <= columns; ++column) {
        *block_corners_.At(column, row) =
            CornerLabel(column * kBlockTiles * kTilePx, row * kBlockTiles * kTilePx);
      }
    });
    is_block_uniform_ = Image8(columns, rows, 1);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        *is_block_uniform_.At(column, row) =
            AreCornersAlike(block_corners_, column, row) && !touched_.IsBlockTouched(column, row);
      }
    }
  }

  bool IsInUniformBlock(int column, int row) const {
    return *is_block_uniform_.At(column / kBlockTiles, row / kBlockTiles) != 0;
  }

  // The corners of tiles, but for those amid uniform blocks.
  void LookAtTiles() {
    const int columns = touched_.tile_columns() + 1;
    const int rows = touched_.tile_rows() + 1;
    corners_ = Image16(columns, rows, 1);
    tbb::parallel_for(0, rows, [&](int row) {
      for (int column = 0; column < columns; ++column) {
        bool is_needed = false;
        for (int j = std::max(0, row - 1); j <= std::min(row, rows - 2); ++j) {
          for (int i = std::max(0, column - 1); i <= std::min(column, columns - 2); ++i) {
            is_needed = is_needed || !IsInUniformBlock(i, j);
          }
        }
        if (is_needed) *corners_.At(column, row) = CornerLabel(column * kTilePx, row * kTilePx);
      }
    });
  }

  void FillTile(int column, int row) {
    const int x0 = column * kTilePx;
    const int y0 = row * kTilePx;
    if (IsInUniformBlock(column, row)) {
      Fill(x0, y0, kTilePx, block_corners_.At(column / kBlockTiles, row / kBlockTiles));
    } else if (AreCornersAlike(corners_, column, row) && !touched_.IsTileTouched(column, row)) {
      Fill(x0, y0, kTilePx, corners_.At(column, row));
    } else {
      FillQuarters(column, row);
    }
  }

  // The same for a tile's quarters; corners that several of them share are asked for once.
  void FillQuarters(int column, int row) {
    const int x0 = column * kTilePx;
    const int y0 = row * kTilePx;
    const uint16_t* top = corners_.At(column, row);
    const uint16_t* bottom = corners_.At(column, row + 1);
    std::array<int, 9> labels_of_corners;
    labels_of_corners.fill(-1);
    labels_of_corners[0] = top[0];
    labels_of_corners[2] = top[1];
    labels_of_corners[6] = bottom[0];
    labels_of_corners[8] = bottom[1];
    const auto ask = [&](int i, int j) {
      int& label = labels_of_corners[3 * j + i];
      if (label < 0) label = CornerLabel(x0 + i * kQuarterPx, y0 + j * kQuarterPx);
      return label;
    };
    for (int quarter = 0; quarter < 4; ++quarter) {
      const int i = quarter % 2;
      const int j = quarter / 2;
      const auto label = static_cast<uint16_t>(ask(2 * i, 2 * j));
      const bool is_uniform = !touched_.IsTouched(2 * column + i, 2 * row + j) &&
                              ask(1, 1) == label && ask(1, 2 * j) == label &&
                              ask(2 * i, 1) == label;
      Fill(x0 + i * kQuarterPx, y0 + j * kQuarterPx, kQuarterPx, is_uniform ? &label : nullptr);
    }
  }

  // All the same, or a ray for each pixel.
  void Fill(int x0, int y0, int side, const uint16_t* label) {
    const int x1 = std::min(x0 + side, camera_.width_px);
    const int y1 = std::min(y0 + side, camera_.height_px);
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        *labels_.At(x, y) = label ? *label : LabelAt(x + 0.5, y + 0.5);
      }
    }
  }

  const Visibility& visibility_;
  const Camera& camera_;
  const TouchedQuarters& touched_;
  Eigen::Vector3d position_in_world_;
  Image16 block_corners_;
  Image8 is_block_uniform_;
  Image16 corners_;  // of tiles
  Image16 labels_;
};

}  // namespace

Image16 MakeFaceMask(const PolygonModel& model,
                     const Visibility& visibility,
                     const Camera& camera) {
  constexpr int kMaxHalvings = 24;
  TouchedQuarters touched(camera);
  for (const Face& face : model.faces) {
    for (size_t i = 0; i < face.points.size(); ++i) {
      const int next = face.points[(i + 1) % face.points.size()];
      touched.TouchEdge(camera.cam_from_world * model.points_in_world[face.points[i]],
                        camera.cam_from_world * model.points_in_world[next],
                        kMaxHalvings);
    }
  }
  return FaceMaskMaker(visibility, camera, touched).Make();
}

}  // namespace groundglass
