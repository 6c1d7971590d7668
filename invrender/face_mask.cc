// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/invrender.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace groundglass {
namespace {

constexpr int kTilePx = 8;

// Tiles of the image that some projected edge of the model touches.
class TouchedTiles {
 public:
  explicit TouchedTiles(const Camera& camera)
      : camera_(camera),
        columns_((camera.width_px + kTilePx - 1) / kTilePx),
        rows_((camera.height_px + kTilePx - 1) / kTilePx),
        touched_(static_cast<size_t>(columns_) * rows_, 0) {}

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool IsTouched(int column, int row) const {
    return touched_[static_cast<size_t>(row) * columns_ + column] != 0;
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
        Touch(low, high);
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
          std::clamp(std::floor(px / kTilePx), -1.0, static_cast<double>(count)));
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

}  // namespace

Image16 MakeFaceMask(const PolygonModel& model,
                     const Visibility& visibility,
                     const Camera& camera) {
  constexpr int kMaxHalvings = 24;
  TouchedTiles tiles(camera);
  for (const Face& face : model.faces) {
    for (size_t i = 0; i < face.points.size(); ++i) {
      const int next = face.points[(i + 1) % face.points.size()];
      tiles.TouchEdge(camera.cam_from_world * model.points_in_world[face.points[i]],
                      camera.cam_from_world * model.points_in_world[next],
                      kMaxHalvings);
    }
  }
  Image16 labels(camera.width_px, camera.height_px, 1);
  const Eigen::Vector3d position = camera.PositionInWorld();
  const auto label_at = [&](double x, double y) {
    const auto hit = visibility.FirstHit(position, UnprojectToWorld(camera, {x, y}));
    return static_cast<uint16_t>(hit && hit->is_front ? hit->face + 1 : 0);
  };
  // Where faces cut through one another (a chimney sunk into a roof) the answer changes without an
  // edge: the tiles' corners tell.
  const int num_columns = tiles.columns() + 1;
  std::vector<uint16_t> corners(static_cast<size_t>(num_columns) * (tiles.rows() + 1));
  tbb::parallel_for(0, tiles.rows() + 1, [&](int row) {
    for (int column = 0; column < num_columns; ++column) {
      corners[static_cast<size_t>(row) * num_columns + column] = label_at(
          std::min(column * kTilePx, camera.width_px), std::min(row * kTilePx, camera.height_px));
    }
  });
  tbb::parallel_for(0, tiles.rows(), [&](int row) {
    for (int column = 0; column < tiles.columns(); ++column) {
      const uint16_t* top = &corners[static_cast<size_t>(row) * num_columns + column];
      const uint16_t* bottom = top + num_columns;
      const bool is_uniform = !tiles.IsTouched(column, row) && top[0] == top[1] &&
                              top[0] == bottom[0] && top[0] == bottom[1];
      const int x1 = std::min((column + 1) * kTilePx, camera.width_px);
      const int y1 = std::min((row + 1) * kTilePx, camera.height_px);
      for (int y = row * kTilePx; y < y1; ++y) {
        for (int x = column * kTilePx; x < x1; ++x) {
          *labels.At(x, y) = is_uniform ? top[0] : label_at(x + 0.5, y + 0.5);
        }
      }
    }
  });
  return labels;
}

}  // namespace groundglass
