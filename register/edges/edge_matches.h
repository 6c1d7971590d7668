// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/edges/edge_evidence.h"
#include "register/edges/edge_samples.h"

#include <string>
#include <vector>

namespace groundglass {

struct MatchOptions {
  // The narrowest range that is searched, px.
  double final_range_px = 2.0;
  // Candidates for a sample, and how far their gradient may turn from the sample's normal.
  int max_candidates = 8;
  double gate_deg = 25;
  // Share of samples whose edge the photograph does not show.
  double outlier_share = 0.15;
  // Edge that counts as one independent observation.
  double observation_length_px = 20;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "match options: ") const;
};

// A sample with all that the photograph offers for it.
struct CandidateSample {
  EdgeSample sample;
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();  // where offset 0 lies
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();    // of the projected edge, unit length
  double px_per_unit = 0;
  double range_px = 0;  // to both sides of the origin that were searched
  std::vector<EdgeCandidate> candidates;
};

// Searches the photograph along the normal of each sample: three of the prior's standard deviations
// there times range_sigmas, and at least min_range_px, with three sigmas of a loose model's edges
// on top (EdgeSample::looseness). Samples without a candidate are left out.
std::vector<CandidateSample> FindCandidateSamples(const std::vector<EdgeSample>& samples,
                                                  const EdgeEvidence& evidence,
                                                  const CameraPrior& prior,
                                                  const ParameterProjection& projection,
                                                  double range_sigmas,
                                                  double min_range_px,
                                                  const MatchOptions& options);

// Which of a sample's candidates is meant: the mixture's expectation about predicted_px (an offset
// from the sample's origin), weighted by how likely any of them is right.
struct SoftAssignment {
  double offset_px = 0;  // from the origin
  double precision = 0;  // 1 / px^2; 0 if no candidate is likely
};
SoftAssignment MatchCandidates(const CandidateSample& sample,
                               double predicted_px,
                               double range_px,
                               double noise_px,
                               const MatchOptions& options);

}  // namespace groundglass
