// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine/refine_photograph.h"

#include "register/camera/control_point_cost.h"
#include "register/camera/standard_normal_cost.h"
#include "register/edges/weighted_median.h"
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

// Spread of the residuals of the likely matches, by the precision that each was given; nothing if
// none can be seen.
std::optional<ResidualSpread> SpreadOf(const std::vector<AlignedSample>& aligned,
                                       const CameraPrior& prior,
                                       const CameraParameters& whitened) {
  const ParameterProjection projection = prior.ProjectionAt(whitened);
  std::vector<WeightedValue> residuals;
  for (const AlignedSample& sample : aligned) {
    const auto projected = projection.Project(sample.point_in_world);
    if (!projected) continue;
    residuals.push_back(
        {sample.normal.dot(projected->image_px - sample.origin_px) - sample.offset_px,
         sample.precision});
  }
  if (residuals.empty()) return std::nullopt;
  return MeasureSpread(std::move(residuals));
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
  options.function_tolerance = 1e-8;
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

}  // namespace

void RefineOptions::Check(const std::string& path) const {
  CheckFromTo(start_sigmas, 0, 10, path + "start_sigmas");
  CheckFromTo(shrink, 0.01, 0.99, path + "shrink");
  CheckFromTo(spacing_px, 0.1, 1000, path + "spacing_px");
  matching.Check(path + "matching.");
  bias.Check(path + "bias.");
  CheckFromTo(min_noise_px, 1e-6, matching.final_range_px / 2, path + "min_noise_px");
}

Refinement RefinePhotograph(const CameraParameters& start,
                            const EdgeModel& edge_model,
                            const EdgeEvidence& evidence,
                            const CameraPrior& prior,
                            const RefineOptions& options,
                            const std::vector<ControlPoint>& points) {
  // Steps at the final range: the mixture settles in a few.
  constexpr int kFinalSteps = 3;

  Refinement refinement;
  refinement.whitened = start;
  const auto sample_edges = [&] {
    refinement.samples =
        SampleVisibleEdges(edge_model, prior.CameraAt(refinement.whitened), -3, options.spacing_px);
  };
  sample_edges();

  double widest_prior_px = 0;
  {
    const ParameterProjection projection = prior.ProjectionAt(start);
    for (const ProjectedSample& sample : ProjectSamples(refinement.samples, projection)) {
      if (sample.is_valid) {
        widest_prior_px = std::max(widest_prior_px, (sample.jacobian * prior.root).norm());
      }
    }
  }

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
    if (aligned.size() < 8) return false;
    step = Solve(aligned, points, prior, max_iterations, refinement.whitened, with_covariance);
    refinement.whitened = step.whitened;
    return true;
  };

  while (3 * annealing.range_sigmas * widest_prior_px > options.matching.final_range_px) {
    if (!match_and_solve(3, false)) return refinement;
    annealing.range_sigmas *= options.shrink;
  }
  // What is visible may have changed on the way.
  sample_edges();
  annealing.range_sigmas = 0;
  CameraParameters before = refinement.whitened;
  for (int number = 1; number <= kFinalSteps; ++number) {
    before = refinement.whitened;
    if (!match_and_solve(5, number == kFinalSteps)) return refinement;
    refinement.spread = SpreadOf(aligned, prior, refinement.whitened);
    annealing.noise_px = std::clamp(refinement.spread ? refinement.spread->robust_sigma_px : 1,
                                    options.min_noise_px,
                                    options.matching.final_range_px / 2);
  }
  refinement.noise_px = annealing.noise_px;
  refinement.num_matched = static_cast<int>(aligned.size());
  if (!step.has_solution) {
    refinement.outcome = Refinement::Outcome::kNoSolution;
    return refinement;
  }
  if (!step.covariance) {
    refinement.outcome = Refinement::Outcome::kNoCovariance;
    return refinement;
  }
  refinement.covariance =
      *step.covariance +
      SystematicCovariance(aligned, prior, refinement.whitened, *step.covariance);
  // Between the last two steps a settled solution moves by less than its own uncertainty.
  const bool is_settled =
      (refinement.whitened - before).squaredNorm() < 0.25 * refinement.covariance.trace() + 1e-6;
  refinement.outcome =
      is_settled ? Refinement::Outcome::kConverged : Refinement::Outcome::kNotSettled;
  return refinement;
}

}  // namespace groundglass
