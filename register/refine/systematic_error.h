// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/refine/edge_alignment_cost.h"

#include <span>
#include <vector>

namespace groundglass {

// Ways in which all edges may lie off together, one sigma each as the samples' shared_bias_px say:
// upright edges all to the right, all away from the picture's middle, or leaning over (those in the
// upper half to the right, those in the lower to the left); the others all down, all away from the
// middle, or sloping (down on the right, up on the left).
// How each changes the whitened residuals of samples of ONE edge.
constexpr int kNumSystematicModes = 6;
// Each edge is moved by so many of them. What it may lie off in all, one sigma, is the root of
// this times what it may in each.
constexpr int kNumModesOfAnEdge = kNumSystematicModes / 2;
Eigen::Matrix<double, Eigen::Dynamic, kNumSystematicModes> WhitenedSystematicModes(
    std::span<const AlignedSample> samples, int width_px, int height_px);

// What the building's own details add to a solution's uncertainty when they push all edges the same
// way: every window has the same reveal, every corner the same joint on its sunny side. Such errors
// do not average out over many edges, so they are no part of the solution's own covariance.
// covariance: of the whitened parameters at the solution. Returns what to add to it.
CameraCovariance SystematicCovariance(const std::vector<AlignedSample>& samples,
                                      const CameraPrior& prior,
                                      const CameraParameters& whitened,
                                      const CameraCovariance& covariance);

}  // namespace groundglass
