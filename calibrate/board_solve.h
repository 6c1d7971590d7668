// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "calibrate/april_tag_corners.h"
#include "calibrate/board.h"
#include "scene/camera.h"

#include <Eigen/Dense>

#include <vector>

namespace groundglass {

// The AprilTags measured in one photograph and where its camera stood.
struct BoardShot {
  size_t photograph = 0;                    // which one, in the order given
  std::vector<AprilTagCorners> april_tags;  // id: index on the board
  RigidTransform cam_from_board;
};

// The lens' numbers in the order in which they are solved for, as in a view file but for the
// angle: view angle (radians), aspect, shift_x, shift_y, k1, k2.
using LensVector = Eigen::Matrix<double, 6, 1>;
using LensMatrix = Eigen::Matrix<double, 6, 6>;

// The intrinsics that they stand for, with an identity pose (view_tag.h has the formula).
Camera CameraFromLensVector(const LensVector& lens, int width_px, int height_px);

// The homography from the board's plane to pixels, by the normalised linear method (Hartley &
// Zisserman 2004, algorithm 4.2); pixels are about center_px.
Eigen::Matrix3d EstimateHomography(const Board& board,
                                   const BoardShot& shot,
                                   const Eigen::Vector2d& center_px,
                                   double scale_px);

// A first lens without distortion, its principal point in the middle, from the photographs'
// homographies, and each photograph's pose with it (Zhang, PAMI 2000, sections 3.1 and 3.3).
// Sets the shots' poses.
LensVector EstimateLens(const Board& board,
                        std::vector<BoardShot>& shots,
                        int width_px,
                        int height_px);

struct LensSolution {
  LensVector lens;
  LensMatrix covariance;  // scaled by the residuals' spread; zeros for what was held fixed
  double rms_px = 0;      // of the corners, each axis apart
  int num_corners = 0;
};

// Minimises the corners' whitened distances from the projected board over the lens and all poses.
// AprilTags that stay far outside the others' spread are removed, and shots left without AprilTags.
// Throws Error if the photographs leave the lens undetermined.
LensSolution RefineLens(const Board& board,
                        const BoardOptions& options,
                        const LensVector& start,
                        std::vector<BoardShot>& shots,
                        int width_px,
                        int height_px);

}  // namespace groundglass
