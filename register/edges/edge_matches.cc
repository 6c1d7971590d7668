// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/edges/edge_matches.h"

#include "scene/check_option.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

double NormalDensity(double x, double sigma) {
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2 * std::numbers::pi));
}

}  // namespace

void MatchOptions::Check(const std::string& path) const {
  CheckAbove(final_range_px, 0, path + "final_range_px");
  CheckFromTo(max_candidates, 1, 1000, path + "max_candidates");
  CheckFromTo(gate_deg, 0.1, 90, path + "gate_deg");
  CheckFromTo(outlier_share, 0.001, 0.999, path + "outlier_share");
  CheckAbove(observation_length_px, 0, path + "observation_length_px");
}

std::vector<CandidateSample> FindCandidateSamples(const std::vector<EdgeSample>& samples,
                                                  const EdgeEvidence& evidence,
                                                  const CameraPrior& prior,
                                                  const ParameterProjection& projection,
                                                  double range_sigmas,
                                                  double min_range_px,
                                                  const MatchOptions& options) {
  std::vector<CandidateSample> found;
  found.reserve(samples.size());
  const std::vector<ProjectedSample> projected = ProjectSamples(samples, projection);
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!projected[i].is_valid) continue;
    const double prior_px = (projected[i].jacobian * prior.root).norm();
    const double loose_px = 3 * samples[i].looseness * projected[i].px_per_unit;
    const double range_px =
        std::max(std::hypot(min_range_px, loose_px), 3 * range_sigmas * prior_px);
    std::vector<EdgeCandidate> candidates = evidence.FindCandidates(projected[i].image_px,
                                                                    projected[i].normal,
                                                                    range_px,
                                                                    options.max_candidates,
                                                                    options.gate_deg);
    if (candidates.empty()) continue;
    found.push_back({samples[i],
                     projected[i].image_px,
                     projected[i].normal,
                     projected[i].px_per_unit,
                     range_px,
                     std::move(candidates)});
  }
  return found;
}

SoftAssignment MatchCandidates(const CandidateSample& sample,
                               double predicted_px,
                               double range_px,
                               double noise_px,
                               const MatchOptions& options) {
  const double width_px = std::max(noise_px, range_px / 3);
  double strength_sum = 0;
  for (const EdgeCandidate& candidate : sample.candidates) {
    if (std::abs(candidate.offset_px - predicted_px) > range_px) continue;
    strength_sum += std::abs(candidate.strength);
  }
  double likelihood = options.outlier_share / (2 * range_px);
  double weight_sum = 0;
  double offset_sum = 0;
  for (const EdgeCandidate& candidate : sample.candidates) {
    const double distance_px = candidate.offset_px - predicted_px;
    if (std::abs(distance_px) > range_px) continue;
    const double weight = (1 - options.outlier_share) * std::abs(candidate.strength) /
                          strength_sum * NormalDensity(distance_px, width_px);
    likelihood += weight;
    weight_sum += weight;
    offset_sum += weight * candidate.offset_px;
  }
  if (!(weight_sum > 1e-3 * likelihood)) return {};
  const double observations =
      std::min(1.0, sample.sample.spacing_px / options.observation_length_px);
  return {offset_sum / weight_sum, weight_sum / likelihood * observations / (width_px * width_px)};
}

}  // namespace groundglass
