// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts/charts.h"
#include "invrender/photos/prepared_photo.h"

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

namespace groundglass {

// Samples along a side of a patch.
constexpr int kPatchSide = 30;
using PatchSamples = Eigen::Array<uint16_t, kPatchSide, kPatchSide>;

// How one photograph shows a patch.
struct PatchView {
  int photo = -1;
  double px_per_unit = 0;        // at the patch's middle
  Eigen::Matrix2d step_from_px;  // patch's steps for one pixel along the photograph's x and y
  PatchSamples luma;             // (row, column): encoded as sRGB, 65535 is white
};

// A small square of the model's surface, sampled at steps of a pixel of the photograph that shows
// it best, in all photographs whose pixels are at most twice as long.
struct Patch {
  int chart = -1;
  int face = -1;
  Eigen::Vector2d corner_in_plane = Eigen::Vector2d::Zero();  // of the first sample
  double step = 0;                                            // model's unit
  std::vector<PatchView> views;                               // two or more, the best first
};

// Patches spread over all faces, where two photographs or more show them whole and clear of
// borders. Goes photograph by photograph, so that each is decoded once.
std::vector<Patch> SamplePatches(const PolygonModel& model,
                                 const std::vector<Chart>& charts,
                                 const std::vector<PreparedPhoto>& photos);

// The x of least squares (normal x = right) that is nowhere below `least`, by projected
// Gauss-Seidel (Cryer 1971). The matrix must be positive definite.
Eigen::VectorXd SolveBounded(const Eigen::MatrixXd& normal,
                             const Eigen::VectorXd& right,
                             double least);

}  // namespace groundglass
