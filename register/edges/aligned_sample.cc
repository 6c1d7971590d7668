// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/aligned_sample.h"

#include "scene/check_option.h"

#include <cmath>

namespace groundglass {

void EdgeBias::Check(const std::string& path) const {
  CheckAbove(edge_offset_sigmas, 0, path + "edge_offset_sigmas");
  CheckAbove(edge_turn_sigmas, 0, path + "edge_turn_sigmas");
  CheckAtLeast(shared_offset_sigmas, 0, path + "shared_offset_sigmas");
}

AlignedSample MakeAlignedSample(const CandidateSample& found,
                                const SoftAssignment& match,
                                double model_sigma,
                                const EdgeBias& bias) {
  const double px_per_sigma = model_sigma * found.px_per_unit;
  AlignedSample aligned;
  aligned.point_in_world = found.sample.point_in_world;
  aligned.edge = found.sample.edge;
  aligned.along = found.sample.along;
  aligned.origin_px = found.origin_px;
  aligned.normal = found.normal;
  aligned.offset_px = match.offset_px;
  aligned.precision = match.precision;
  const double tolerance_px = found.sample.tolerance * found.px_per_unit;
  aligned.bias_px = {std::hypot(bias.edge_offset_sigmas * px_per_sigma, tolerance_px),
                     bias.edge_turn_sigmas * px_per_sigma * found.sample.along};
  aligned.shared_bias_px = bias.shared_offset_sigmas * px_per_sigma;
  aligned.is_upright = std::abs(found.sample.direction_in_world.z()) > 0.7;
  return aligned;
}

}  // namespace groundglass
