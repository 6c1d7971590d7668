// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera_prior.h"
#include "register/edge_evidence.h"
#include "register/edge_samples.h"

#include <vector>

namespace groundglass {

struct ScoreOptions {
  // Spread of a right match about the model's edge, px.
  double noise_px = 1.0;
  // Candidates are counted this far to both sides, to tell how crowded the place is.
  double crowd_range_px = 12;
  double vote_length_px = 20;
  double gate_deg = 25;
};

// How much better than chance the model's edges meet the photograph's, in nats: for each edge,
// with the contrast sign that suits it better, one vote for each vote_length_px of
//   log(0.35 + 0.65 p / q),
// p the density of a right match at the nearest candidate, q the density of candidates thereabouts.
// Its zero means something: a wrong camera scores below it.
struct AlignmentScore {
  double nats = 0;
  double votes = 0;  // that were cast; the score of a perfect alignment grows with them
};
AlignmentScore ScoreAlignment(const std::vector<EdgeSample>& samples,
                              const ParameterProjection& projection,
                              const EdgeEvidence& evidence,
                              const ScoreOptions& options);

}  // namespace groundglass
