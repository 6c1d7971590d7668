// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/find_solutions.h"

#include "register/pointed_prior.h"
#include "register/write_solution.h"

#include <algorithm>

namespace groundglass {
namespace {

// Fewer samples than this are no view of the model.
constexpr size_t kMinSamples = 10;

// What is visible from a prior's mean, widened so that edges just outside may come in.
std::vector<EdgeSample> SamplesToSearch(const EdgeModel& edge_model, const CameraPrior& prior) {
  return SampleVisibleEdges(
      edge_model, prior.CameraAt(CameraParameters::Zero()), 0.02 * prior.width_px, 10);
}

void SortBestFirst(std::vector<Solution>& solutions) {
  std::stable_sort(solutions.begin(), solutions.end(), [](const Solution& a, const Solution& b) {
    return a.TotalScore() > b.TotalScore();
  });
}

}  // namespace

std::vector<Solution> FindSolutions(const EdgeModel& edge_model,
                                    const EdgeEvidence& evidence,
                                    const CameraPrior& prior,
                                    const std::vector<ControlPoint>& points,
                                    const RegisterOptions& options) {
  const HypothesisOptions& search = options.hypotheses;
  const PointedPrior pointed = NarrowByPoints(points, prior);
  const std::vector<EdgeSample> start_samples = SamplesToSearch(edge_model, pointed.prior);
  if (start_samples.size() < kMinSamples) return {};
  // Where a person has pointed, the whole of what is left uncertain is searched.
  RefineOptions refine = options.refine;
  refine.start_sigmas = std::min(refine.start_sigmas, NarrowingOf(pointed, prior, start_samples));

  std::vector<Solution> solutions;
  const auto refine_and_score = [&](const CameraParameters& whitened) {
    Solution solution;
    solution.refinement = RefineFrom(whitened, edge_model, evidence, prior, refine, points);
    const ParameterProjection projection = prior.ProjectionAt(solution.refinement.whitened);
    solution.score =
        ScoreAlignment(solution.refinement.samples, projection, evidence, options.score);
    solution.control_point_nats = ControlPointNats(points, projection);
    solutions.push_back(std::move(solution));
  };
  if (search.max_starts == 0) {
    refine_and_score(pointed.offset);
    return solutions;
  }
  for (const Hypothesis& hypothesis :
       FindHypotheses(start_samples, pointed.prior, evidence, search)) {
    refine_and_score(pointed.offset + pointed.map * hypothesis.whitened);
  }
  SortBestFirst(solutions);

  if (BendOfPrior(start_samples, pointed.prior) <=
      search.step_cells * prior.width_px / search.width_cells) {
    return solutions;
  }
  double reach = 1;
  for (int round = 1; round < search.max_rounds; ++round) {
    const AlignmentScore& best = solutions.front().score;
    if (best.nats >= search.again_below_nats_per_vote * best.votes) break;
    reach /= 2;
    const size_t num_centres = std::min(solutions.size(), static_cast<size_t>(search.num_centres));
    std::vector<CameraParameters> centres;
    for (size_t i = 0; i < num_centres; ++i) centres.push_back(solutions[i].refinement.whitened);
    for (const CameraParameters& centre : centres) {
      CameraPrior about = pointed.prior;
      about.mean = prior.ParametersAt(centre);
      about.root *= reach;
      const std::vector<EdgeSample> samples = SamplesToSearch(edge_model, about);
      if (samples.size() < kMinSamples) continue;
      for (const Hypothesis& hypothesis : FindHypotheses(samples, about, evidence, search)) {
        refine_and_score(centre + reach * (pointed.map * hypothesis.whitened));
      }
    }
    SortBestFirst(solutions);
  }
  return solutions;
}

Rival FindRival(const std::vector<Solution>& solutions,
                const CameraPrior& prior,
                const RegisterOptions& options) {
  const Refinement& best = solutions.front().refinement;
  const std::vector<Eigen::Vector3d> points_in_world = PointsOf(best.samples);
  const ParameterProjection projection = prior.ProjectionAt(best.whitened);
  for (const Solution& solution : solutions) {
    const double distance_px = MeanDisplacementPx(
        points_in_world, projection, prior.ProjectionAt(solution.refinement.whitened));
    if (distance_px > options.rival_distance_px * prior.width_px / 1200.0) {
      return {&solution, distance_px};
    }
  }
  return {};
}

}  // namespace groundglass
