// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/edges/edge_matches.h"

#include <Eigen/Dense>

#include <string>

namespace groundglass {

// How far the building's lines lie from the model's: windows are recessed, eaves overhang, plans
// are rounded. One standard deviation each, in units of the model's own (ModelSigma); the figures
// were found on buildings, whose models have 0.03 m.
struct EdgeBias {
  // How far a model edge may lie from the building's as a whole, and its ends apart from that.
  double edge_offset_sigmas = 0.037 / 0.03;
  double edge_turn_sigmas = 0.037 / 0.03;
  // What all edges may lie off together (reveals, joints, frames). Widens the covariance and leaves
  // the solution alone.
  double shared_offset_sigmas = 0.016 / 0.03;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "edge bias: ") const;
};

// One edge sample with what the photograph says of it.
struct AlignedSample {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  int edge = -1;
  double along = 0;  // where on the edge: -1 at its start, 1 at its end
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();  // where offset 0 lies
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double offset_px = 0;  // where the photograph's edge lies, from origin along normal
  double precision = 0;  // 1 / variance of offset_px, 1 / px^2; 0 for an outlier
  // The model edge's own error here: one sigma of its shift as a whole, and of its turn (signed).
  Eigen::Vector2d bias_px = Eigen::Vector2d::Zero();
  // One sigma of the error that it shares with all edges that run its way (SystematicCovariance).
  double shared_bias_px = 0;
  bool is_upright = false;
};
// model_sigma: in the model's unit.
AlignedSample MakeAlignedSample(const CandidateSample& found,
                                const SoftAssignment& match,
                                double model_sigma,
                                const EdgeBias& bias);

}  // namespace groundglass
