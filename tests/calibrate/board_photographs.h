// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "calibrate/calibrate_board.h"
#include "scene/camera.h"

#include <random>
#include <vector>

namespace groundglass {

// Photographs a flat board without the code under test: rays through a distorted lens, many to a
// pixel, then blur, uneven light and noise.
class BoardStudio {
 public:
  // `lens`: intrinsics; its pose is not used.
  BoardStudio(const Board& board, const Camera& lens);

  struct Look {
    double blur_px = 0.7;  // sigma of the lens' blur, in linear light
    double noise = 2;      // sigma, in 8-bit sRGB grey levels
    bool uneven_light = true;
  };
  Image8 Photograph(const RigidTransform& cam_from_board,
                    const Look& look,
                    std::mt19937_64& random) const;

  // Poses from many sides that keep the whole board in the frame, or nearly.
  std::vector<RigidTransform> MakePoses(int count, std::mt19937_64& random) const;

 private:
  bool IsWhite(double x, double y) const;

  Board board_;
  Camera lens_;
  std::vector<Eigen::Vector2f> rays_;  // x / z, y / z of each sample, row by row
  Image8 cells_;                       // the board's AprilTags, one cell a pixel: 255 white
};

}  // namespace groundglass
