// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/score.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace groundglass {

AlignmentScore ScoreAlignment(const std::vector<EdgeSample>& samples,
                              const ParameterProjection& projection,
                              const EdgeEvidence& evidence,
                              const ScoreOptions& options) {
  const std::vector<ProjectedSample> projected = ProjectSamples(samples, projection);
  AlignmentScore score;
  for (size_t start = 0; start < samples.size();) {
    size_t end = start;
    // By contrast sign: how many candidates there are, and each sample's nearest.
    double crowd[2] = {0, 0};
    std::vector<double> nearest[2];
    std::vector<double> votes;
    for (; end < samples.size() && samples[end].edge == samples[start].edge; ++end) {
      if (!projected[end].is_valid) continue;
      votes.push_back(samples[end].spacing_px / options.vote_length_px);
      nearest[0].push_back(1e9);
      nearest[1].push_back(1e9);
      for (const EdgeCandidate& candidate : evidence.FindCandidates(projected[end].image_px,
                                                                    projected[end].normal,
                                                                    options.crowd_range_px,
                                                                    64,
                                                                    options.gate_deg)) {
        const int sign = candidate.strength > 0 ? 1 : 0;
        crowd[sign] += 1;
        nearest[sign].back() = std::min(nearest[sign].back(), std::abs(candidate.offset_px));
      }
    }
    double best = -1e30;
    for (int sign = 0; sign < 2; ++sign) {
      // Half a candidate more than was counted, so that an empty place is not a certain one.
      const double density =
          (crowd[sign] + 0.5) / (2 * options.crowd_range_px * static_cast<double>(votes.size()));
      double sum = 0;
      for (size_t i = 0; i < votes.size(); ++i) {
        const double x = nearest[sign][i] / options.noise_px;
        const double right =
            std::exp(-0.5 * x * x) / (options.noise_px * std::sqrt(2 * std::numbers::pi));
        sum += votes[i] * std::log(0.35 + 0.65 * right / density);
      }
      best = std::max(best, sum);
    }
    if (!votes.empty()) score.nats += best;
    for (const double vote : votes) score.votes += vote;
    start = end;
  }
  return score;
}

}  // namespace groundglass
