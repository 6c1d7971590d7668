// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/match_together.h"

#include "register/joint/image_edge_error.h"
#include "register/refine/systematic_error.h"
#include "scene/quantile.h"
#include "scene/weighted_quantile.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace groundglass {
namespace {

// How far to both sides of where a sample is predicted its edge is taken: at first all of a loose
// model's error, at the end what single photographs see of it.
double RangeOf(const CandidateSample& found, double shrink, const JointOptions& options) {
  const double loose_px = found.sample.looseness * found.px_per_unit;
  const double final_px =
      std::hypot(options.matching.final_range_px, 3 * options.own.edge_offset_sigmas * loose_px);
  return std::max(final_px, shrink * std::hypot(options.start_range_px, 3 * loose_px));
}

// Returns how large the own error of each of its runs is, in units of state.own_bias.
std::vector<double> MatchPhotograph(size_t p,
                                    double shrink,
                                    const JointOptions& options,
                                    JointState& state) {
  const AlignedPhotograph& photograph = state.photographs[p];
  MovingPhotograph& moving = state.moving[p];
  const ParameterProjection projection = state.ProjectionOf(moving);
  std::vector<WeightedValue<double>> residuals;
  std::vector<double> run_residuals_px;
  moving.num_matched = 0;
  std::vector<double> own_sizes;
  const std::vector<CandidateSample>& found = photograph.found;
  for (size_t start = 0; start < found.size();) {
    MatchedRun run{p, found[start].sample.edge, {}};
    run_residuals_px.clear();
    size_t end = start;
    for (; end < found.size() && found[end].sample.edge == run.edge; ++end) {
      const CandidateSample& sample = found[end];
      const auto projected = projection.Project(
          sample.sample.point_in_world + state.DisplacementOf(run.edge, sample.sample.along));
      if (!projected) continue;
      const double predicted_px = sample.normal.dot(projected->image_px - sample.origin_px);
      const double range_px = RangeOf(sample, shrink, options);
      const SoftAssignment match =
          MatchCandidates(sample, predicted_px, range_px, moving.noise_px, options.matching);
      if (!(match.precision > 0)) continue;
      run.samples.push_back(
          MakeAlignedSample(sample, match, state.edge_model.sigma, state.own_bias));
      run_residuals_px.push_back(match.offset_px - predicted_px);
      residuals.push_back({std::abs(match.offset_px - predicted_px), match.precision});
    }
    start = end;
    if (run.samples.empty()) continue;
    const ImageEdgeError own =
        EstimateImageEdgeError(run.samples, run_residuals_px, options.own_degrees_of_freedom);
    for (AlignedSample& sample : run.samples) sample.bias_px *= own.widening;
    own_sizes.push_back(own.size);
    moving.num_matched += static_cast<int>(run.samples.size());
    ++state.edges[run.edge].num_photographs;
    state.runs.push_back(std::move(run));
  }
  moving.noise_px = std::clamp(1.4826 * WeightedMedian(residuals, 1.0),
                               options.min_noise_px,
                               options.matching.final_range_px / 2);
  return own_sizes;
}

}  // namespace

void MatchTogether(double shrink, const JointOptions& options, JointState& state) {
  state.runs.clear();
  for (MovingEdge& edge : state.edges) edge.num_photographs = 0;
  double own_size_sum = 0;
  for (size_t p = 0; p < state.photographs.size(); ++p) {
    for (const double size : MatchPhotograph(p, shrink, options, state)) own_size_sum += size;
  }
  if (state.runs.empty()) return;
  EdgeBias& own = state.own_bias;
  own.edge_offset_sigmas = std::clamp(
      own.edge_offset_sigmas * std::sqrt(own_size_sum / static_cast<double>(state.runs.size())),
      options.least_own_offset_sigmas,
      options.most_own_offset_sigmas);
  own.edge_turn_sigmas = own.edge_offset_sigmas;
}

void EstimateSharedOffset(const JointOptions& options, JointState& state) {
  std::vector<double> offsets_sigmas;
  for (size_t number = 0; number < state.edges.size(); ++number) {
    const MovingEdge& edge = state.edges[number];
    // The ground has a level of its own; its edges' displacements stay zero and say nothing.
    if (edge.num_photographs < 2 || state.edge_model.tolerances[number].on_ground) continue;
    offsets_sigmas.push_back(edge.frame.Displacement(edge.displacement, 0).norm() /
                             state.edge_model.sigma);
  }
  double whole_sigmas = options.most_shared_offset_sigmas;
  if (!offsets_sigmas.empty()) {
    const size_t upper_quartile = offsets_sigmas.size() * 3 / 4;
    whole_sigmas = std::clamp(ValueOfRank(std::move(offsets_sigmas), upper_quartile),
                              options.least_shared_offset_sigmas,
                              options.most_shared_offset_sigmas);
  }
  // An edge is displaced by all of its modes together, no further than edges are found to be.
  state.own_bias.shared_offset_sigmas = whole_sigmas / std::sqrt(kNumModesOfAnEdge);
}

void EstimateGroupOffset(const JointOptions& options, JointState& state) {
  std::vector<bool> is_moved(state.groups.size(), false);
  for (const std::vector<EdgeGroupPart>& parts : state.groups_of_edge) {
    for (const EdgeGroupPart& part : parts) is_moved[part.group] = true;
  }
  std::vector<double> offsets_sigmas;
  for (size_t i = 0; i < state.groups.size(); ++i) {
    if (!is_moved[i]) continue;
    for (int k = 0; k < state.groups[i].num_numbers; ++k) {
      offsets_sigmas.push_back(std::abs(state.groups[i].move[k]) * state.group_offset_sigmas);
    }
  }
  if (static_cast<int>(offsets_sigmas.size()) < options.least_groups) return;
  const size_t upper_quartile = offsets_sigmas.size() * 3 / 4;
  const double share =
      ValueOfRank(std::move(offsets_sigmas), upper_quartile) / options.usual_group_quartile_sigmas;
  const double offset_sigmas = std::clamp(share * options.group_offset_sigmas,
                                          options.least_group_offset_sigmas,
                                          options.group_offset_sigmas);
  const double factor = offset_sigmas / state.group_offset_sigmas;
  for (std::vector<EdgeGroupPart>& parts : state.groups_of_edge) {
    for (EdgeGroupPart& part : parts) part.directions *= factor;
  }
  for (MovingGroup& group : state.groups) group.move /= factor;
  state.group_offset_sigmas = offset_sigmas;
}

}  // namespace groundglass
