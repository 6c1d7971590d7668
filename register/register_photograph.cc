// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register_photograph.h"

#include "register/pointed_prior.h"
#include "register/verdict.h"
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

// Mean distance between the edge samples as two cameras project them, px.
double MeanDisplacement(const std::vector<EdgeSample>& samples,
                        const ParameterProjection& one,
                        const ParameterProjection& other) {
  double sum = 0;
  int count = 0;
  for (const EdgeSample& sample : samples) {
    const auto a = one.Project(sample.point_in_world);
    const auto b = other.Project(sample.point_in_world);
    if (!a || !b) continue;
    sum += (a->image_px - b->image_px).norm();
    ++count;
  }
  return count ? sum / count : 0;
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

}  // namespace

void RegisterOptions::Check() const {
  prior.Check();
  overrule.Check();
  if (!(max_width_px >= 64)) throw Error("option max-width: must be at least 64 px");
  if (!(refine.shrink > 0 && refine.shrink < 1)) {
    throw Error("option shrink: must lie between 0 and 1");
  }
}

Registration RegisterPhotograph(const std::string& name,
                                const Image8& grey8,
                                const Image8& ignore,
                                const ViewTag& measured,
                                const std::optional<Lens>& lens,
                                const EdgeModel& edge_model,
                                const RegisterOptions& options) {
  options.Check();
  Registration registration;
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
    OverruleVerdict(options.overrule, registration);
    return registration;
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
  for (const Hypothesis& hypothesis : hypotheses) {
    Solution solution;
    solution.refinement = RefineFrom(pointed.offset + pointed.map * hypothesis.whitened,
                                     edge_model,
                                     evidence,
                                     prior,
                                     measured,
                                     width_px,
                                     height_px,
                                     refine,
                                     points);
    const ParameterProjection projection(
        prior.mean + prior.root * solution.refinement.whitened, measured.k2, width_px, height_px);
    solution.score =
        ScoreAlignment(solution.refinement.samples, projection, evidence, options.score);
    solution.control_point_nats = ControlPointNats(points, projection);
    solutions.push_back(std::move(solution));
  }
  std::stable_sort(solutions.begin(), solutions.end(), [](const Solution& a, const Solution& b) {
    return a.TotalScore() > b.TotalScore();
  });
  const Solution& best = solutions.front();
  const ParameterProjection best_projection(
      prior.mean + prior.root * best.refinement.whitened, measured.k2, width_px, height_px);
  const Solution* rival = nullptr;
  double rival_distance_px = 0;
  for (const Solution& solution : solutions) {
    const ParameterProjection projection(
        prior.mean + prior.root * solution.refinement.whitened, measured.k2, width_px, height_px);
    rival_distance_px = MeanDisplacement(best.refinement.samples, best_projection, projection);
    if (rival_distance_px > options.rival_distance_px * width_px / 1200.0) {
      rival = &solution;
      break;
    }
  }

  const CameraParameters parameters = prior.mean + prior.root * best.refinement.whitened;
  registration.covariance = prior.root * best.refinement.covariance * prior.root.transpose();
  registration.sigmas = registration.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  registration.num_samples = best.refinement.num_matched;
  registration.rms_px = best.refinement.noise_px / scale;
  registration.score_nats = best.score.nats;
  registration.margin_nats = rival ? best.TotalScore() - rival->TotalScore() : 1e6;
  registration.moved_px =
      MeanDisplacement(best.refinement.samples,
                       ParameterProjection(prior.mean, measured.k2, width_px, height_px),
                       best_projection) /
      scale;
  JudgeRegistration(best, rival, rival_distance_px / scale, prior, options, registration);
  JudgeControlPoints(
      points, best_projection, scale, options.max_control_point_sigmas, registration);
  OverruleVerdict(options.overrule, registration);
  if (registration.verdict != Verdict::kRejected) {
    registration.corrected = TagFromParameters(parameters, measured);
  }
  return registration;
}

}  // namespace groundglass
