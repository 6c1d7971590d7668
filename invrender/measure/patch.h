// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

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

}  // namespace groundglass
