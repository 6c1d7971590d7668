// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/group_profile.h"

#include "scene/check_option.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace groundglass {
namespace {

// Which share of the length of edges that a photograph shows belongs to each group.
std::vector<double> SharesOfGroups(const std::vector<EdgeSample>& samples,
                                   const EdgeGroups& groups) {
  std::vector<double> shares(groups.num_numbers.size(), 0);
  double all_px = 0;
  for (const EdgeSample& sample : samples) {
    all_px += sample.spacing_px;
    for (const EdgeGroupPart& part : groups.of_edge[sample.edge]) {
      shares[part.group] += sample.spacing_px;
    }
  }
  for (double& share : shares) share /= std::max(1.0, all_px);
  return shares;
}

// And to a set.
double ShareOf(const std::vector<std::optional<Eigen::Vector3d>>& moves,
               const std::vector<EdgeSample>& samples) {
  double all_px = 0;
  double own_px = 0;
  for (const EdgeSample& sample : samples) {
    all_px += sample.spacing_px;
    if (moves[sample.edge]) own_px += sample.spacing_px;
  }
  return own_px / std::max(1.0, all_px);
}

// A set of which a photograph shows enough, and where its edges go.
struct AskedSet {
  int set = -1;
  double share = 0;
  std::vector<std::optional<Eigen::Vector3d>> moves;
};

std::vector<AskedSet> FindAskedSets(const std::vector<EdgeSample>& samples,
                                    const EdgeGroups& groups,
                                    const GroupProfileOptions& options) {
  const std::vector<double> shares = SharesOfGroups(samples, groups);
  std::vector<AskedSet> asked;
  for (size_t set = 0; set < groups.sets.size(); ++set) {
    // No less than its share: an edge may be of two of its groups.
    double most_share = 0;
    for (const int group : groups.sets[set].groups) most_share += shares[group];
    if (most_share < options.least_share) continue;
    AskedSet candidate{static_cast<int>(set), 0, MovesOfSet(groups.sets[set], groups)};
    candidate.share = ShareOf(candidate.moves, samples);
    if (candidate.share < options.least_share || candidate.share > options.most_share) continue;
    asked.push_back(std::move(candidate));
  }
  if (asked.size() > static_cast<size_t>(options.most_sets)) {
    std::stable_sort(asked.begin(), asked.end(), [](const AskedSet& a, const AskedSet& b) {
      return a.share > b.share;
    });
    asked.resize(options.most_sets);
  }
  return asked;
}

// How far, px, the farthest offset moves samples in the picture; no less than options say.
double SpareFor(const std::vector<EdgeSample>& samples,
                const ParameterProjection& projection,
                double model_sigma,
                const GroupProfileOptions& options) {
  double spare_px = options.least_spare_px;
  for (const ProjectedSample& seen : ProjectSamples(samples, projection)) {
    if (!seen.is_valid) continue;
    spare_px = std::max(spare_px, options.reach_sigmas * model_sigma * seen.px_per_unit);
  }
  return std::min(spare_px, options.most_spare_px);
}

// What a set's edges score at each offset from where they are drawn.
std::vector<double> ScoreMoved(std::vector<ScoreSample> samples,
                               const std::vector<Eigen::Vector3d>& direction_of_sample,
                               double model_sigma,
                               const ParameterProjection& projection,
                               const ScoreOptions& score,
                               const GroupProfileOptions& options) {
  std::vector<Eigen::Vector3d> drawn_in_world;
  for (const ScoreSample& sample : samples) drawn_in_world.push_back(sample.point_in_world);
  std::vector<double> nats;
  const auto num_offsets =
      static_cast<size_t>(2 * std::floor(options.reach_sigmas / options.step_sigmas) + 1);
  for (size_t entry = 0; entry < num_offsets; ++entry) {
    const double offset = OffsetSigmas(entry, options) * model_sigma;
    for (size_t i = 0; i < samples.size(); ++i) {
      samples[i].point_in_world = drawn_in_world[i] + offset * direction_of_sample[i];
    }
    nats.push_back(ScoreFromSamples(samples, projection, score).nats);
  }
  return nats;
}

}  // namespace

void GroupProfileOptions::Check(const std::string& path) const {
  CheckFromTo(least_share, 0, 1, path + "least_share");
  CheckFromTo(most_share, 0, 1, path + "most_share");
  CheckAbove(reach_sigmas, 0, path + "reach_sigmas");
  CheckFromTo(step_sigmas, 1e-3 * reach_sigmas, reach_sigmas, path + "step_sigmas");
  CheckFromTo(most_sets, 1, 1000000, path + "most_sets");
  CheckAtLeast(least_spare_px, 0, path + "least_spare_px");
  CheckAtLeast(most_spare_px, least_spare_px, path + "most_spare_px");
}

double OffsetSigmas(size_t entry, const GroupProfileOptions& options) {
  return options.step_sigmas *
         (static_cast<double>(entry) - std::floor(options.reach_sigmas / options.step_sigmas));
}

std::vector<GroupProfile> FindGroupProfiles(const Solution& best,
                                            const EdgeModel& edge_model,
                                            const EdgeEvidence& evidence,
                                            const CameraPrior& prior,
                                            const SolutionOptions& solutions,
                                            const GroupProfileOptions& options) {
  std::vector<GroupProfile> profiles;
  for (const AskedSet& asked : FindAskedSets(best.refinement.samples, edge_model.groups, options)) {
    std::vector<bool> is_left_out;
    for (const auto& move : asked.moves) is_left_out.push_back(move.has_value());
    const Refinement without = RefineWithoutEdges(
        best.refinement.whitened, edge_model, is_left_out, evidence, prior, solutions.refine);
    if (without.outcome != Refinement::Outcome::kConverged &&
        without.outcome != Refinement::Outcome::kNotSettled) {
      continue;
    }
    const ParameterProjection projection = prior.ProjectionAt(without.whitened);
    std::vector<EdgeSample> own;
    std::vector<EdgeSample> others;
    for (const EdgeSample& sample : SampleVisibleEdges(edge_model,
                                                       prior.CameraAt(without.whitened),
                                                       -solutions.refine.border_px,
                                                       solutions.refine.spacing_px)) {
      (asked.moves[sample.edge] ? own : others).push_back(sample);
    }
    const std::vector<ScoreSample> own_samples =
        FindScoreSamples(own,
                         projection,
                         evidence,
                         SpareFor(own, projection, edge_model.sigma, options),
                         solutions.score);
    std::vector<Eigen::Vector3d> directions;
    for (const ScoreSample& sample : own_samples) directions.push_back(*asked.moves[sample.edge]);
    GroupProfile profile{asked.set, {}};
    profile.gain_nats =
        ScoreMoved(own_samples, directions, edge_model.sigma, projection, solutions.score, options);
    const double others_nats = ScoreAlignment(others, projection, evidence, solutions.score).nats -
                               0.5 * without.whitened.squaredNorm() - best.TotalScore();
    for (double& nats : profile.gain_nats) nats += others_nats;
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace groundglass
