// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/find_solutions.h"

#include "register/camera/control_point_posterior.h"
#include "register/camera/mean_displacement.h"
#include "register/search/uncertainty_ratio.h"
#include "scene/check_option.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Finds solutions by search, refinement and score, round by round.
class SolutionSearch {
 public:
  SolutionSearch(const EdgeModel& edge_model,
                 const EdgeEvidence& evidence,
                 const CameraPrior& prior,
                 const std::vector<ControlPoint>& points,
                 const SolutionOptions& options)
      : edge_model_(edge_model),
        evidence_(evidence),
        prior_(prior),
        points_(points),
        options_(options),
        posterior_(ConditionOnControlPoints(points, prior)) {}

  std::vector<Solution> Run() {
    const std::vector<EdgeSample> samples = SamplesFrom(posterior_.prior);
    if (!IsEnough(samples)) return {};
    // Where a person has pointed, the whole of what is left uncertain is searched.
    refine_options_ = options_.refine;
    refine_options_.start_sigmas =
        std::min(refine_options_.start_sigmas, UncertaintyRatio(posterior_, prior_, samples));
    if (options_.hypotheses.max_starts == 0) {
      RefineAndScore({posterior_.offset, 0});
      return std::move(solutions_);
    }
    SearchPrior(samples);
    const double step_px =
        options_.hypotheses.step_cells * prior_.width_px / options_.hypotheses.width_cells;
    if (PriorNonlinearity(samples, posterior_.prior) > step_px) SearchAgainAboutTheBest();
    return std::move(solutions_);
  }

 private:
  // What is visible from a prior's mean, widened so that edges just outside may come in.
  std::vector<EdgeSample> SamplesFrom(const CameraPrior& prior) const {
    return SampleVisibleEdges(edge_model_,
                              prior.CameraAt(CameraParameters::Zero()),
                              options_.search_frame_share * prior.width_px,
                              options_.search_spacing_px);
  }

  bool IsEnough(const std::vector<EdgeSample>& samples) const {
    return samples.size() >= static_cast<size_t>(options_.min_samples);
  }

  void RefineAndScore(const Hypothesis& start) {
    SolutionOptions options = options_;
    options.refine = refine_options_;
    solutions_.push_back(SolveFrom(start, edge_model_, evidence_, prior_, points_, options));
  }

  void SearchPrior(const std::vector<EdgeSample>& samples) {
    for (const Hypothesis& hypothesis : options_.stages.find_hypotheses(
             samples, posterior_.prior, evidence_, options_.hypotheses)) {
      RefineAndScore({posterior_.offset + posterior_.map * hypothesis.whitened, hypothesis.score});
    }
    SortBestFirst();
  }

  // The search is linear: where the prior bends, it begins anew about the best solutions, with half
  // the reach each time, until one of them fits as a right one does.
  void SearchAgainAboutTheBest() {
    double reach = 1;
    for (int round = 1; round < options_.hypotheses.max_rounds; ++round) {
      const AlignmentScore& best = solutions_.front().score;
      if (best.nats >= options_.hypotheses.again_below_nats_per_observation * best.observations)
        break;
      reach /= 2;
      for (const CameraParameters& centre : BestCentres()) {
        CameraPrior about = posterior_.prior;
        about.mean = prior_.ParametersAt(centre);
        about.root *= reach;
        const std::vector<EdgeSample> samples = SamplesFrom(about);
        if (!IsEnough(samples)) continue;
        for (const Hypothesis& hypothesis :
             options_.stages.find_hypotheses(samples, about, evidence_, options_.hypotheses)) {
          RefineAndScore(
              {centre + reach * (posterior_.map * hypothesis.whitened), hypothesis.score});
        }
      }
      SortBestFirst();
    }
  }

  std::vector<CameraParameters> BestCentres() const {
    const size_t count =
        std::min(solutions_.size(), static_cast<size_t>(options_.hypotheses.num_centres));
    std::vector<CameraParameters> centres;
    for (size_t i = 0; i < count; ++i) centres.push_back(solutions_[i].refinement.whitened);
    return centres;
  }

  void SortBestFirst() {
    std::stable_sort(solutions_.begin(), solutions_.end(), [](const auto& a, const auto& b) {
      return a.TotalScore() > b.TotalScore();
    });
  }

  const EdgeModel& edge_model_;
  const EdgeEvidence& evidence_;
  const CameraPrior& prior_;
  const std::vector<ControlPoint>& points_;
  const SolutionOptions& options_;
  const ControlPointPosterior posterior_;
  RefineOptions refine_options_;
  std::vector<Solution> solutions_;
};

}  // namespace

void SolutionOptions::Check(const std::string& path) const {
  hypotheses.Check(path + "hypotheses.");
  refine.Check(path + "refine.");
  score.Check(path + "score.");
  CheckFromTo(search_frame_share, 0, 1, path + "search_frame_share");
  CheckAbove(search_spacing_px, 0, path + "search_spacing_px");
  CheckAtLeast(min_samples, 1, path + "min_samples");
  CheckAtLeast(distinct_distance_px, 0, path + "distinct_distance_px");
}

std::vector<Solution> FindSolutions(const EdgeModel& edge_model,
                                    const EdgeEvidence& evidence,
                                    const CameraPrior& prior,
                                    const std::vector<ControlPoint>& points,
                                    const SolutionOptions& options) {
  return SolutionSearch(edge_model, evidence, prior, points, options).Run();
}

Solution SolveFrom(const Hypothesis& start,
                   const EdgeModel& edge_model,
                   const EdgeEvidence& evidence,
                   const CameraPrior& prior,
                   const std::vector<ControlPoint>& points,
                   const SolutionOptions& options) {
  Solution solution;
  solution.start = start;
  solution.refinement =
      options.stages.refine(start.whitened, edge_model, evidence, prior, options.refine, points);
  const ParameterProjection projection = prior.ProjectionAt(solution.refinement.whitened);
  solution.score =
      options.stages.score(solution.refinement.samples, projection, evidence, options.score);
  solution.control_point_nats = ControlPointNats(points, projection);
  return solution;
}

SecondBest FindSecondBest(const Solution& best,
                          const CameraPrior& best_prior,
                          const std::vector<Solution>& solutions,
                          const CameraPrior& prior,
                          const SolutionOptions& options) {
  const std::vector<Eigen::Vector3d> points_in_world = PointsOf(best.refinement.samples);
  const ParameterProjection projection = best_prior.ProjectionAt(best.refinement.whitened);
  for (const Solution& solution : solutions) {
    const double distance_px = MeanDisplacementPx(
        points_in_world, projection, prior.ProjectionAt(solution.refinement.whitened));
    if (distance_px > options.distinct_distance_px * prior.width_px / 1200.0) {
      return {&solution, distance_px};
    }
  }
  return {};
}

}  // namespace groundglass
