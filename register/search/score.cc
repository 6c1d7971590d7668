// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/search/score.h"

#include "scene/check_option.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace groundglass {
namespace {

// A sample as the camera that is scored sees it.
struct SeenSample {
  const ScoreSample* sample = nullptr;
  double offset_px = 0;  // of where it is seen, from the sample's origin
};

// The nats of one edge with one contrast sign, if the edge lies off by `shift` of the model's
// sigmas.
double NatsAt(double shift,
              bool is_positive,
              double density,
              std::span<const SeenSample> seen,
              const ScoreOptions& options) {
  double sum = 0;
  for (const SeenSample& here : seen) {
    double nearest = 1e9;
    for (const EdgeCandidate& candidate : here.sample->candidates) {
      if ((candidate.strength > 0) != is_positive) continue;
      const double offset_px = candidate.offset_px - here.offset_px;
      if (std::abs(offset_px) > here.sample->range_px) continue;
      nearest = std::min(nearest, std::abs(offset_px - shift * here.sample->loose_px));
    }
    const double x = nearest / options.noise_px;
    const double right =
        std::exp(-0.5 * x * x) / (options.noise_px * std::sqrt(2 * std::numbers::pi));
    sum += here.sample->observations *
           std::log(1 - options.shown_share + options.shown_share * right / density);
  }
  return sum;
}

// The same, averaged over where the edge may lie: the logarithm of the mean over a normal
// distribution of shifts, in steps that the noise bridges.
double NatsOfEdge(bool is_positive,
                  double density,
                  std::span<const SeenSample> seen,
                  const ScoreOptions& options) {
  double loosest_px = 0;
  for (const SeenSample& here : seen) loosest_px = std::max(loosest_px, here.sample->loose_px);
  if (loosest_px == 0) return NatsAt(0, is_positive, density, seen, options);
  constexpr double kReach = 3;
  const int steps = static_cast<int>(std::ceil(kReach * loosest_px / options.noise_px));
  std::vector<double> nats;
  std::vector<double> weights;
  for (int i = -steps; i <= steps; ++i) {
    const double shift = kReach * i / steps;
    nats.push_back(NatsAt(shift, is_positive, density, seen, options));
    weights.push_back(std::exp(-0.5 * shift * shift));
  }
  const double most = *std::max_element(nats.begin(), nats.end());
  double sum = 0;
  double weight_sum = 0;
  for (size_t i = 0; i < nats.size(); ++i) {
    sum += weights[i] * std::exp(nats[i] - most);
    weight_sum += weights[i];
  }
  return most + std::log(sum / weight_sum);
}

}  // namespace

void ScoreOptions::Check(const std::string& path) const {
  CheckAbove(noise_px, 0, path + "noise_px");
  CheckAbove(clutter_range_px, 0, path + "clutter_range_px");
  CheckAbove(observation_length_px, 0, path + "observation_length_px");
  CheckFromTo(gate_deg, 0.1, 90, path + "gate_deg");
  CheckFromTo(shown_share, 0.01, 0.99, path + "shown_share");
  CheckAtLeast(max_candidates, 1, path + "max_candidates");
}

std::vector<ScoreSample> FindScoreSamples(const std::vector<EdgeSample>& samples,
                                          const ParameterProjection& projection,
                                          const EdgeEvidence& evidence,
                                          double spare_px,
                                          const ScoreOptions& options) {
  const std::vector<ProjectedSample> projected = ProjectSamples(samples, projection);
  std::vector<ScoreSample> found;
  found.reserve(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!projected[i].is_valid) continue;
    const double loose_px = samples[i].looseness * projected[i].px_per_unit;
    const double range_px = std::hypot(options.clutter_range_px, 3 * loose_px);
    found.push_back({samples[i].point_in_world,
                     samples[i].edge,
                     samples[i].spacing_px / options.observation_length_px,
                     projected[i].image_px,
                     projected[i].normal,
                     loose_px,
                     range_px,
                     evidence.FindCandidates(projected[i].image_px,
                                             projected[i].normal,
                                             range_px + spare_px,
                                             options.max_candidates,
                                             options.gate_deg)});
  }
  return found;
}

std::vector<ScoreSample> WithEdgesMoved(std::vector<ScoreSample> samples,
                                        const std::vector<Eigen::Vector3d>& edge_moves_in_world,
                                        double times) {
  if (edge_moves_in_world.empty()) return samples;
  for (ScoreSample& sample : samples) {
    sample.point_in_world += times * edge_moves_in_world[sample.edge];
  }
  return samples;
}

std::vector<EdgeScore> ScoreEdges(const std::vector<ScoreSample>& samples,
                                  const ParameterProjection& projection,
                                  double offset_px,
                                  const ScoreOptions& options) {
  std::vector<EdgeScore> scores;
  std::vector<SeenSample> seen;
  for (size_t start = 0; start < samples.size();) {
    size_t end = start;
    // By contrast sign: how many candidates there are.
    double crowd[2] = {0, 0};
    double width_px = 0;  // in which they were counted
    seen.clear();
    AlignmentScore score;
    for (; end < samples.size() && samples[end].edge == samples[start].edge; ++end) {
      const ScoreSample& sample = samples[end];
      const auto image_px = projection.ImageOf(sample.point_in_world);
      if (!image_px) continue;
      const double seen_px = sample.normal.dot(*image_px - sample.origin_px) + offset_px;
      seen.push_back({&sample, seen_px});
      width_px += 2 * sample.range_px;
      score.observations += sample.observations;
      for (const EdgeCandidate& candidate : sample.candidates) {
        if (std::abs(candidate.offset_px - seen_px) > sample.range_px) continue;
        crowd[candidate.strength > 0 ? 1 : 0] += 1;
      }
    }
    if (!seen.empty()) {
      // Half a candidate more than was counted, so that an empty place is not a certain one.
      score.nats = std::max(NatsOfEdge(false, (crowd[0] + 0.5) / width_px, seen, options),
                            NatsOfEdge(true, (crowd[1] + 0.5) / width_px, seen, options));
      scores.push_back({samples[start].edge, samples[start].normal, score});
    }
    start = end;
  }
  return scores;
}

AlignmentScore ScoreFromSamples(const std::vector<ScoreSample>& samples,
                                const ParameterProjection& projection,
                                const ScoreOptions& options) {
  AlignmentScore sum;
  for (const EdgeScore& edge : ScoreEdges(samples, projection, 0, options)) {
    sum.nats += edge.score.nats;
    sum.observations += edge.score.observations;
  }
  return sum;
}

AlignmentScore ScoreAlignment(const std::vector<EdgeSample>& samples,
                              const ParameterProjection& projection,
                              const EdgeEvidence& evidence,
                              const ScoreOptions& options) {
  return ScoreFromSamples(
      FindScoreSamples(samples, projection, evidence, 0, options), projection, options);
}

}  // namespace groundglass
