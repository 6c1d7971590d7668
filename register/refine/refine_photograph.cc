// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/refine_photograph.h"

#include "register/camera/control_point_cost.h"
#include "register/camera/standard_normal_cost.h"
#include "register/refine/edge_alignment_cost.h"
#include "register/refine/systematic_error.h"
#include "scene/check_option.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// How ranges and widths stand at one step of the annealing.
struct Annealing {
  double range_sigmas;  // search range, as a factor of the prior's 3 sigma along the normal
  double noise_px;      // spread of a right match at the end
};

// Finds each sample's candidates and turns them into one offset with a precision.
std::vector<AlignedSample> AlignSamples(const std::vector<EdgeSample>& samples,
                                        const EdgeEvidence& evidence,
                                        const CameraPrior& prior,
                                        const ParameterProjection& projection,
                                        double model_sigma,
                                        const Annealing& annealing,
                                        const RefineOptions& options) {
  std::vector<AlignedSample> aligned;
  aligned.reserve(samples.size());
  for (const CandidateSample& found : FindCandidateSamples(samples,
                                                           evidence,
                                                           prior,
                                                           projection,
                                                           annealing.range_sigmas,
                                                           options.matching.final_range_px,
                                                           options.matching)) {
    const SoftAssignment match =
        MatchCandidates(found, 0, found.range_px, annealing.noise_px, options.matching);
    if (match.precision > 0) {
      aligned.push_back(MakeAlignedSample(found, match, model_sigma, options.bias));
    }
  }
  return aligned;
}

// One robust step.
struct Step {
  bool has_solution = false;
  CameraParameters whitened = CameraParameters::Zero();  // the start, if there is no solution
  std::optional<CameraCovariance> covariance;            // where asked for, and computable
};

// Correspondences held, Ceres solves for the whitened parameters.
Step Solve(const std::vector<AlignedSample>& aligned,
           const std::vector<ControlPoint>& points,
           const CameraPrior& prior,
           int max_iterations,
           double function_tolerance,
           const CameraParameters& start,
           bool with_covariance) {
  Step step;
  step.whitened = start;
  CameraParameters& whitened = step.whitened;
  ceres::Problem::Options problem_options;
  problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  EdgeAlignmentCost alignment(aligned, prior);
  ControlPointCost pointing(points, prior);
  StandardNormalCost<kNumCameraParameters> whitened_prior;
  ceres::Problem problem(problem_options);
  problem.AddResidualBlock(&alignment, nullptr, whitened.data());
  problem.AddResidualBlock(&whitened_prior, nullptr, whitened.data());
  if (!points.empty()) problem.AddResidualBlock(&pointing, nullptr, whitened.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = max_iterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = function_tolerance;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  step.has_solution = summary.IsSolutionUsable() && whitened.allFinite();
  if (!step.has_solution) whitened = start;
  if (!with_covariance || !step.has_solution) return step;
  ceres::Covariance::Options covariance_options;
  covariance_options.algorithm_type = ceres::DENSE_SVD;
  ceres::Covariance estimate(covariance_options);
  const double* block = whitened.data();
  const std::vector<std::pair<const double*, const double*>> blocks = {{block, block}};
  if (estimate.Compute(blocks, &problem)) {
    Eigen::Matrix<double, kNumCameraParameters, kNumCameraParameters, Eigen::RowMajor> rows;
    estimate.GetCovarianceBlock(block, block, rows.data());
    if (rows.allFinite()) step.covariance = rows;
  }
  return step;
}

// How far the prior lets the sample move that it lets move farthest, one sigma, px.
double WidestPriorPx(const std::vector<EdgeSample>& samples,
                     const CameraPrior& prior,
                     const CameraParameters& whitened) {
  double widest_px = 0;
  for (const ProjectedSample& sample : ProjectSamples(samples, prior.ProjectionAt(whitened))) {
    if (sample.is_valid) widest_px = std::max(widest_px, (sample.jacobian * prior.root).norm());
  }
  return widest_px;
}

// How certain the solution of the last step is, and whether it has settled since the step before.
void Conclude(const Step& step,
              const std::vector<AlignedSample>& aligned,
              const CameraPrior& prior,
              const CameraParameters& before,
              const RefineOptions& options,
              Refinement& refinement) {
  using Outcome = Refinement::Outcome;
  if (!step.has_solution) {
    refinement.outcome = Outcome::kNoSolution;
    return;
  }
  if (!step.covariance) {
    refinement.outcome = Outcome::kNoCovariance;
    return;
  }
  refinement.covariance =
      *step.covariance +
      SystematicCovariance(aligned, prior, refinement.whitened, *step.covariance);
  const double settled_squared = options.settled_sigmas * options.settled_sigmas;
  const bool is_settled = (refinement.whitened - before).squaredNorm() <
                          settled_squared * refinement.covariance.trace() + 1e-6;
  refinement.outcome = is_settled ? Outcome::kConverged : Outcome::kNotSettled;
}

// is_left_out: of the model's edges; empty: none.
Refinement Refine(const CameraParameters& start,
                  const EdgeModel& edge_model,
                  const std::vector<bool>& is_left_out,
                  const EdgeEvidence& evidence,
                  const CameraPrior& prior,
                  const RefineOptions& options,
                  const std::vector<ControlPoint>& points) {
  Refinement refinement;
  refinement.whitened = start;
  const auto sample_edges = [&] {
    refinement.samples = SampleVisibleEdges(
        edge_model, prior.CameraAt(refinement.whitened), -options.border_px, options.spacing_px);
    if (is_left_out.empty()) return;
    std::erase_if(refinement.samples,
                  [&](const EdgeSample& sample) { return is_left_out[sample.edge]; });
  };
  sample_edges();

  const double widest_prior_px = WidestPriorPx(refinement.samples, prior, start);
  Annealing annealing{options.start_sigmas, 1};
  std::vector<AlignedSample> aligned;
  Step step;
  const auto match_and_solve = [&](int max_iterations, bool with_covariance) {
    aligned = AlignSamples(refinement.samples,
                           evidence,
                           prior,
                           prior.ProjectionAt(refinement.whitened),
                           edge_model.sigma,
                           annealing,
                           options);
    if (aligned.size() < static_cast<size_t>(options.min_matched)) return false;
    step = Solve(aligned,
                 points,
                 prior,
                 max_iterations,
                 options.function_tolerance,
                 refinement.whitened,
                 with_covariance);
    refinement.whitened = step.whitened;
    return true;
  };

  while (3 * annealing.range_sigmas * widest_prior_px > options.matching.final_range_px) {
    if (!match_and_solve(options.annealing_iterations, false)) return refinement;
    annealing.range_sigmas *= options.shrink;
  }
  // What is visible may have changed on the way.
  sample_edges();
  annealing.range_sigmas = 0;
  CameraParameters before = refinement.whitened;
  for (int number = 1; number <= options.num_final_steps; ++number) {
    before = refinement.whitened;
    const bool is_last = number == options.num_final_steps;
    if (!match_and_solve(options.final_iterations, is_last)) return refinement;
    refinement.residuals = ResidualsOf(aligned, prior.ProjectionAt(refinement.whitened));
    const std::optional<ResidualSpread> spread = SpreadOf(refinement.residuals);
    annealing.noise_px = std::clamp(spread ? spread->robust_sigma_px : 1,
                                    options.min_noise_px,
                                    options.matching.final_range_px / 2);
  }
  refinement.noise_px = annealing.noise_px;
  refinement.num_matched = static_cast<int>(aligned.size());
  Conclude(step, aligned, prior, before, options, refinement);
  return refinement;
}

}  // namespace

void RefineOptions::Check(const std::string& path) const {
  CheckFromTo(start_sigmas, 0, 10, path + "start_sigmas");
  CheckFromTo(shrink, 0.01, 0.99, path + "shrink");
  CheckFromTo(spacing_px, 0.1, 1000, path + "spacing_px");
  matching.Check(path + "matching.");
  bias.Check(path + "bias.");
  CheckAtLeast(border_px, 0, path + "border_px");
  CheckFromTo(min_noise_px, 1e-6, matching.final_range_px / 2, path + "min_noise_px");
  CheckAtLeast(min_matched, 1, path + "min_matched");
  CheckFromTo(num_final_steps, 1, 100, path + "num_final_steps");
  CheckFromTo(annealing_iterations, 1, 1000, path + "annealing_iterations");
  CheckFromTo(final_iterations, 1, 1000, path + "final_iterations");
  CheckFromTo(function_tolerance, 0, 1, path + "function_tolerance");
  CheckAbove(settled_sigmas, 0, path + "settled_sigmas");
}

Refinement RefinePhotograph(const CameraParameters& start,
                            const EdgeModel& edge_model,
                            const EdgeEvidence& evidence,
                            const CameraPrior& prior,
                            const RefineOptions& options,
                            const std::vector<ControlPoint>& points) {
  return Refine(start, edge_model, {}, evidence, prior, options, points);
}

Refinement RefineWithoutEdges(const CameraParameters& start,
                              const EdgeModel& edge_model,
                              const std::vector<bool>& is_left_out,
                              const EdgeEvidence& evidence,
                              const CameraPrior& prior,
                              const RefineOptions& options) {
  return Refine(start, edge_model, is_left_out, evidence, prior, options, {});
}

}  // namespace groundglass
