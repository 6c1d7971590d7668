// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register_photograph.h"

#include "register/pointed_prior.h"
#include "register/verdict.h"
#include "register/write_solution.h"
#include "scene/error.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

Image8 Resized(const Image8& image, int width, int height, int interpolation) {
  if (image.Empty()) return image;
  Image8 resized(width, height, 1);
  const cv::Mat from(image.height, image.width, CV_8UC1, const_cast<uint8_t*>(image.values.data()));
  cv::Mat to(height, width, CV_8UC1, resized.values.data());
  cv::resize(from, to, to.size(), 0, 0, interpolation);
  return resized;
}

std::vector<Eigen::Vector3d> PointsOf(const std::vector<EdgeSample>& samples) {
  std::vector<Eigen::Vector3d> points_in_world;
  points_in_world.reserve(samples.size());
  for (const EdgeSample& sample : samples) points_in_world.push_back(sample.point_in_world);
  return points_in_world;
}

// The photograph's own control points, in pixels of a picture of another size.
std::vector<ControlPoint> PointsIn(const std::string& photograph,
                                   const std::vector<ControlPoint>& points,
                                   double scale) {
  std::vector<ControlPoint> own;
  for (const ControlPoint& point : points) {
    if (point.photograph != photograph) continue;
    own.push_back(point);
    own.back().image_px *= scale;
    own.back().sigma_px *= scale;
  }
  return own;
}

void SortBestFirst(std::vector<Solution>& solutions) {
  std::stable_sort(solutions.begin(), solutions.end(), [](const Solution& a, const Solution& b) {
    return a.TotalScore() > b.TotalScore();
  });
}

}  // namespace

void RegisterOptions::Check() const {
  prior.Check();
  overrule.Check();
  if (!(max_width_px >= 64)) throw Error("option max-width: must be at least 64 px");
  if (!(refine.shrink > 0 && refine.shrink < 1)) {
    throw Error("option shrink: must lie between 0 and 1");
  }
}

PhotographAlignment AlignPhotograph(const std::string& name,
                                    const Image8& grey8,
                                    const Image8& ignore,
                                    const ViewTag& measured,
                                    const std::optional<Lens>& lens,
                                    const EdgeModel& edge_model,
                                    const RegisterOptions& options) {
  options.Check();
  PhotographAlignment alignment;
  Registration& registration = alignment.registration;
  registration.name = name;
  registration.width_px = grey8.width;
  registration.height_px = grey8.height;
  registration.measured = measured;
  registration.corrected = measured;

  // The parameters are angles and shares of the frame, so the working size does not enter them.
  const double scale = std::min(1.0, static_cast<double>(options.max_width_px) / grey8.width);
  const int width_px = static_cast<int>(std::lround(grey8.width * scale));
  const int height_px = static_cast<int>(std::lround(grey8.height * scale));
  const bool is_reduced = width_px != grey8.width;
  const EdgeEvidence evidence(
      is_reduced ? Resized(grey8, width_px, height_px, cv::INTER_AREA) : grey8,
      is_reduced ? Resized(ignore, width_px, height_px, cv::INTER_NEAREST) : ignore);

  const CameraPrior prior = MakeCameraPrior(measured, edge_model.model.unit, lens, options.prior);
  registration.prior_sigmas = prior.sigmas;
  registration.sigmas = prior.sigmas;
  const std::vector<ControlPoint> points = PointsIn(name, options.control_points, scale);
  const PointedPrior pointed = NarrowByPoints(points, prior, measured, width_px, height_px);

  // Starts: what is visible under the tag, widened so that edges just outside may come in.
  const Camera start_camera =
      CameraFromParameters(pointed.prior.mean, measured, width_px, height_px);
  const std::vector<EdgeSample> start_samples =
      SampleVisibleEdges(edge_model, start_camera, 0.02 * width_px, 10);
  if (start_samples.size() < 10) {
    registration.reasons.push_back("the measured tag sees almost nothing of the model");
    registration.covariance = prior.root * prior.root.transpose();
    return alignment;
  }
  std::vector<Hypothesis> hypotheses = {{}};  // the tag itself
  if (options.hypotheses.max_starts > 0) {
    hypotheses = FindHypotheses(
        start_samples, pointed.prior, measured, width_px, height_px, evidence, options.hypotheses);
  }
  // Where a person has pointed, the whole of what is left uncertain is searched.
  RefineOptions refine = options.refine;
  refine.start_sigmas =
      std::min(refine.start_sigmas,
               NarrowingOf(pointed, prior, start_samples, measured, width_px, height_px));

  // Refine and score each.
  std::vector<Solution> solutions;
  const auto refine_and_score = [&](const CameraParameters& whitened) {
    Solution solution;
    solution.refinement = RefineFrom(
        whitened, edge_model, evidence, prior, measured, width_px, height_px, refine, points);
    const ParameterProjection projection(
        prior.mean + prior.root * solution.refinement.whitened, measured.k2, width_px, height_px);
    solution.score =
        ScoreAlignment(solution.refinement.samples, projection, evidence, options.score);
    solution.control_point_nats = ControlPointNats(points, projection);
    solutions.push_back(std::move(solution));
  };
  for (const Hypothesis& hypothesis : hypotheses) {
    refine_and_score(pointed.offset + pointed.map * hypothesis.whitened);
  }
  SortBestFirst(solutions);
  const bool is_bent = BendOfPrior(start_samples, pointed.prior, measured, width_px, height_px) >
                       options.hypotheses.step_cells * width_px / options.hypotheses.width_cells;
  double reach = 1;
  for (int round = 1;
       is_bent && round < options.hypotheses.max_rounds && options.hypotheses.max_starts > 0 &&
       solutions.front().score.nats <
           options.hypotheses.again_below_nats_per_vote * solutions.front().score.votes;
       ++round) {
    reach /= 2;
    std::vector<CameraParameters> centres;
    for (const Solution& solution : solutions) {
      if (static_cast<int>(centres.size()) == options.hypotheses.num_centres) break;
      centres.push_back(solution.refinement.whitened);
    }
    for (const CameraParameters& centre : centres) {
      CameraPrior about = pointed.prior;
      about.mean = prior.mean + prior.root * centre;
      about.root *= reach;
      const std::vector<EdgeSample> samples =
          SampleVisibleEdges(edge_model,
                             CameraFromParameters(about.mean, measured, width_px, height_px),
                             0.02 * width_px,
                             10);
      if (samples.size() < 10) continue;
      for (const Hypothesis& hypothesis : FindHypotheses(
               samples, about, measured, width_px, height_px, evidence, options.hypotheses)) {
        refine_and_score(centre + reach * (pointed.map * hypothesis.whitened));
      }
    }
    SortBestFirst(solutions);
  }
  const Solution& best = solutions.front();
  const ParameterProjection best_projection(
      prior.mean + prior.root * best.refinement.whitened, measured.k2, width_px, height_px);
  const std::vector<Eigen::Vector3d> best_points = PointsOf(best.refinement.samples);
  const Solution* rival = nullptr;
  double rival_distance_px = 0;
  for (const Solution& solution : solutions) {
    const ParameterProjection projection(
        prior.mean + prior.root * solution.refinement.whitened, measured.k2, width_px, height_px);
    rival_distance_px = MeanDisplacementPx(best_points, best_projection, projection);
    if (rival_distance_px > options.rival_distance_px * width_px / 1200.0) {
      rival = &solution;
      break;
    }
  }

  registration.score_nats = best.score.nats;
  registration.margin_nats = rival ? best.TotalScore() - rival->TotalScore() : 1e6;
  WriteSolution({best.refinement.whitened,
                 best.refinement.covariance,
                 best.refinement.noise_px,
                 best.refinement.num_matched},
                prior,
                edge_model.model,
                best_points,
                width_px,
                height_px,
                registration);
  JudgeFit(best, rival, rival_distance_px / scale, options, registration);
  JudgeChange(best.refinement.whitened, prior, options, registration);
  JudgeControlPoints(
      points, best_projection, scale, options.max_control_point_sigmas, registration);
  if (registration.verdict == Verdict::kAccepted && points.empty()) {
    alignment.aligned = {prior,
                         measured,
                         width_px,
                         height_px,
                         FindCandidateSamples(best.refinement.samples,
                                              evidence,
                                              prior,
                                              best_projection,
                                              0,
                                              1.5 * options.joint.start_range_px,
                                              options.joint.matching),
                         best.refinement.whitened,
                         best.refinement.noise_px};
  }
  return alignment;
}

void FinishVerdict(const RegisterOptions& options, PhotographAlignment& alignment) {
  Registration& registration = alignment.registration;
  if (registration.verdict != Verdict::kRejected) {
    JudgeCertainty(alignment.is_refined_together ? options.max_vertex_sigma_px
                                                 : options.max_lone_vertex_sigma_px,
                   registration);
  }
  OverruleVerdict(options.overrule, registration);
  if (registration.verdict == Verdict::kRejected) registration.corrected = registration.measured;
}

Registration RegisterPhotograph(const std::string& name,
                                const Image8& grey8,
                                const Image8& ignore,
                                const ViewTag& measured,
                                const std::optional<Lens>& lens,
                                const EdgeModel& edge_model,
                                const RegisterOptions& options) {
  PhotographAlignment alignment =
      AlignPhotograph(name, grey8, ignore, measured, lens, edge_model, options);
  FinishVerdict(options, alignment);
  return std::move(alignment.registration);
}

}  // namespace groundglass
