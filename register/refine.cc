// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/refine.h"

#include "register/control_point_cost.h"
#include "register/edge_alignment_cost.h"
#include "register/shared_bias.h"
#include "register/whitened_prior_cost.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

double NormalDensity(double x, double sigma) {
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2 * std::numbers::pi));
}

// How ranges and widths stand at one step of the annealing.
struct Annealing {
  double range_sigmas;  // search range, as a factor of the prior's 3 sigma along the normal
  double noise_px;      // spread of a right match at the end
  bool is_final;
};

// Finds each sample's candidates and turns them into one offset with a precision: the mixture's
// expectation, weighted by how likely any of them is right.
std::vector<AlignedSample> MatchSamples(const std::vector<EdgeSample>& samples,
                                        const EdgeEvidence& evidence,
                                        const CameraPrior& prior,
                                        const ParameterProjection& projection,
                                        double units_per_metre,
                                        const Annealing& annealing,
                                        const RefineOptions& options) {
  std::vector<AlignedSample> aligned;
  aligned.reserve(samples.size());
  const std::vector<ProjectedSample> projected = ProjectSamples(samples, projection);
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!projected[i].is_valid) continue;
    const double prior_px = (projected[i].jacobian * prior.root).norm();
    const double range_px = std::max(options.final_range_px, 3 * annealing.range_sigmas * prior_px);
    const double width_px = std::max(annealing.noise_px, range_px / 3);
    const std::vector<EdgeCandidate> candidates = evidence.FindCandidates(projected[i].image_px,
                                                                          projected[i].normal,
                                                                          range_px,
                                                                          options.max_candidates,
                                                                          options.gate_deg);
    if (candidates.empty()) continue;
    double strength_sum = 0;
    for (const EdgeCandidate& candidate : candidates) {
      strength_sum += std::abs(candidate.strength);
    }
    double likelihood = options.outlier_share / (2 * range_px);
    double weight_sum = 0;
    double offset_sum = 0;
    for (const EdgeCandidate& candidate : candidates) {
      const double weight = (1 - options.outlier_share) * std::abs(candidate.strength) /
                            strength_sum * NormalDensity(candidate.offset_px, width_px);
      likelihood += weight;
      weight_sum += weight;
      offset_sum += weight * candidate.offset_px;
    }
    if (!(weight_sum > 1e-3 * likelihood)) continue;
    AlignedSample& sample = aligned.emplace_back();
    sample.point_in_world = samples[i].point_in_world;
    sample.edge = samples[i].edge;
    sample.origin_px = projected[i].image_px;
    sample.normal = projected[i].normal;
    sample.offset_px = offset_sum / weight_sum;
    const double votes = std::min(1.0, samples[i].spacing_px / options.vote_length_px);
    sample.precision = weight_sum / likelihood * votes / (width_px * width_px);
    const double px_per_metre = units_per_metre * projected[i].px_per_unit;
    sample.bias_px = {options.edge_offset_m * px_per_metre,
                      options.edge_turn_m * px_per_metre * samples[i].along};
    sample.shared_bias_px = options.shared_offset_m * px_per_metre;
    sample.is_upright = std::abs(samples[i].direction_in_world.z()) > 0.7;
  }
  return aligned;
}

// Spread of the residuals of the likely matches, px: weighted median of their absolute values.
double EstimateNoise(const std::vector<AlignedSample>& aligned,
                     const CameraPrior& prior,
                     const CameraParameters& whitened,
                     const ViewTag& measured,
                     int width_px,
                     int height_px) {
  const ParameterProjection projection(
      prior.mean + prior.root * whitened, measured.k2, width_px, height_px);
  std::vector<std::pair<double, double>> residuals;
  double total = 0;
  for (const AlignedSample& sample : aligned) {
    const auto projected = projection.Project(sample.point_in_world);
    if (!projected) continue;
    residuals.emplace_back(
        std::abs(sample.normal.dot(projected->image_px - sample.origin_px) - sample.offset_px),
        sample.precision);
    total += sample.precision;
  }
  if (residuals.empty()) return 1;
  std::sort(residuals.begin(), residuals.end());
  double below = 0;
  for (const auto& [residual, precision] : residuals) {
    below += precision;
    if (below >= total / 2) return 1.4826 * residual;
  }
  return 1;
}

// One robust step: correspondences held, Ceres solves for the whitened parameters.
void Solve(const std::vector<AlignedSample>& aligned,
           const std::vector<ControlPoint>& points,
           const CameraPrior& prior,
           const ViewTag& measured,
           int width_px,
           int height_px,
           int max_iterations,
           CameraParameters& whitened,
           CameraCovariance* covariance) {
  ceres::Problem::Options problem_options;
  problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  EdgeAlignmentCost alignment(aligned, prior, measured.k2, width_px, height_px);
  ControlPointCost pointing(points, prior, measured.k2, width_px, height_px);
  WhitenedPriorCost whitened_prior;
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
  if (!covariance) return;
  ceres::Covariance::Options covariance_options;
  covariance_options.algorithm_type = ceres::DENSE_SVD;
  ceres::Covariance estimate(covariance_options);
  const double* block = whitened.data();
  const std::vector<std::pair<const double*, const double*>> blocks = {{block, block}};
  if (estimate.Compute(blocks, &problem)) {
    Eigen::Matrix<double, kNumCameraParameters, kNumCameraParameters, Eigen::RowMajor> rows;
    estimate.GetCovarianceBlock(block, block, rows.data());
    *covariance = rows;
  }
}

}  // namespace

Refinement RefineFrom(const CameraParameters& start,
                      const EdgeModel& edge_model,
                      const EdgeEvidence& evidence,
                      const CameraPrior& prior,
                      const ViewTag& measured,
                      int width_px,
                      int height_px,
                      const RefineOptions& options,
                      const std::vector<ControlPoint>& points) {
  // Steps at the final range: the mixture settles in a few.
  constexpr int kFinalSteps = 3;
  const double units_per_metre = 1 / MetresPerUnit(edge_model.model.unit);

  Refinement refinement;
  refinement.whitened = start;
  const auto sample_edges = [&] {
    const CameraParameters parameters = prior.mean + prior.root * refinement.whitened;
    refinement.samples =
        SampleVisibleEdges(edge_model,
                           CameraFromParameters(parameters, measured, width_px, height_px),
                           -3,
                           options.spacing_px);
  };
  sample_edges();

  double widest_prior_px = 0;
  {
    const ParameterProjection projection(
        prior.mean + prior.root * start, measured.k2, width_px, height_px);
    for (const ProjectedSample& sample : ProjectSamples(refinement.samples, projection)) {
      if (sample.is_valid) {
        widest_prior_px = std::max(widest_prior_px, (sample.jacobian * prior.root).norm());
      }
    }
  }

  Annealing annealing{options.start_sigmas, 1, false};
  std::vector<AlignedSample> aligned;
  const auto match_and_solve = [&](int max_iterations, CameraCovariance* covariance) {
    const ParameterProjection projection(
        prior.mean + prior.root * refinement.whitened, measured.k2, width_px, height_px);
    aligned = MatchSamples(
        refinement.samples, evidence, prior, projection, units_per_metre, annealing, options);
    if (aligned.size() < 8) return false;
    Solve(aligned,
          points,
          prior,
          measured,
          width_px,
          height_px,
          max_iterations,
          refinement.whitened,
          covariance);
    return true;
  };

  while (3 * annealing.range_sigmas * widest_prior_px > options.final_range_px) {
    if (!match_and_solve(3, nullptr)) return refinement;
    annealing.range_sigmas *= options.shrink;
  }
  // What is visible may have changed on the way.
  sample_edges();
  annealing.range_sigmas = 0;
  CameraParameters before = refinement.whitened;
  for (int step = 0; step < kFinalSteps; ++step) {
    before = refinement.whitened;
    const bool is_last = step + 1 == kFinalSteps;
    if (!match_and_solve(5, is_last ? &refinement.covariance : nullptr)) return refinement;
    annealing.noise_px = std::clamp(
        EstimateNoise(aligned, prior, refinement.whitened, measured, width_px, height_px),
        options.min_noise_px,
        options.final_range_px / 2);
  }
  refinement.covariance += SharedBiasCovariance(
      aligned, prior, measured.k2, width_px, height_px, refinement.whitened, refinement.covariance);
  refinement.noise_px = annealing.noise_px;
  refinement.num_matched = static_cast<int>(aligned.size());
  // Between the last two steps a settled solution moves by less than its own uncertainty.
  refinement.has_converged =
      (refinement.whitened - before).squaredNorm() < 0.25 * refinement.covariance.trace() + 1e-6;
  return refinement;
}

}  // namespace groundglass
