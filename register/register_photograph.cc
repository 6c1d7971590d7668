// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register_photograph.h"

#include "register/find_solutions.h"
#include "register/pointed_prior.h"
#include "register/verdict.h"
#include "register/write_solution.h"
#include "scene/check_option.h"
#include "scene/reduce.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// A mask at another size: nearest neighbours.
Image8 ResizedMask(const Image8& mask, int width, int height) {
  if (mask.Empty()) return mask;
  Image8 resized(width, height, 1);
  const cv::Mat from(mask.height, mask.width, CV_8UC1, const_cast<uint8_t*>(mask.values.data()));
  cv::Mat to(height, width, CV_8UC1, resized.values.data());
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_NEAREST);
  return resized;
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
  const std::string path = "registration options: ";
  prior.Check();
  hypotheses.Check(path + "hypotheses.");
  refine.Check(path + "refine.");
  score.Check(path + "score.");
  joint.Check(path + "joint.");
  model_errors.Check(path + "model_errors.");
  CheckFromTo(max_width_px, 64, 100000, path + "max_width_px");
  CheckAtLeast(rival_distance_px, 0, path + "rival_distance_px");
  CheckAtLeast(min_margin_per_vote, 0, path + "min_margin_per_vote");
  CheckAtLeast(min_margin_nats, 0, path + "min_margin_nats");
  CheckAtLeast(min_nats_per_vote, 0, path + "min_nats_per_vote");
  CheckAbove(max_prior_sigmas, 0, path + "max_prior_sigmas");
  CheckAbove(max_prior_chi_squared, 0, path + "max_prior_chi_squared");
  CheckAbove(max_vertex_sigma_px, 0, path + "max_vertex_sigma_px");
  for (const ControlPoint& point : control_points) {
    const std::string of = path + "control_points of " + point.photograph + ": ";
    // A sum is finite if its terms are.
    CheckFinite(point.image_px.sum(), of + "image_px");
    CheckFinite(point.point_in_world.sum(), of + "point_in_world");
    CheckAbove(point.sigma_px, 0, of + "sigma_px");
  }
  CheckAbove(max_control_point_sigmas, 0, path + "max_control_point_sigmas");
  overrule.Check();
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
  const EdgeEvidence evidence(is_reduced ? ReducedInLight(grey8, width_px, height_px) : grey8,
                              is_reduced ? ResizedMask(ignore, width_px, height_px) : ignore);

  const CameraPrior prior = MakeCameraPrior(measured,
                                            width_px,
                                            height_px,
                                            edge_model.model.unit,
                                            lens,
                                            PriorSuitedTo(edge_model.model, options.prior));
  registration.prior_sigmas = prior.sigmas;
  registration.sigmas = prior.sigmas;
  const std::vector<ControlPoint> points = PointsIn(name, options.control_points, scale);
  const std::vector<Solution> solutions =
      FindSolutions(edge_model, evidence, prior, points, options);
  if (solutions.empty()) {
    registration.reasons.push_back("the measured tag sees almost nothing of the model");
    registration.covariance = prior.root * prior.root.transpose();
    return alignment;
  }
  const Solution& best = solutions.front();
  const Refinement& refined = best.refinement;
  const Rival rival = FindRival(solutions, prior, options);

  std::optional<double> rival_nats;
  if (rival.solution) rival_nats = rival.solution->TotalScore();
  Evidence support{best.score, {}, rival.distance_px / scale};
  if (rival_nats) support.margin_nats = best.TotalScore() - *rival_nats;
  WriteSolution({refined.whitened, refined.covariance, refined.num_matched, refined.spread},
                prior,
                edge_model.model,
                PointsOf(refined.samples),
                registration);
  registration.verdict = Verdict::kAccepted;
  JudgeEvidence(support, options, registration);
  JudgeOutcome(refined.outcome, registration);
  JudgeChange(refined.whitened, prior, options, registration);
  const ParameterProjection projection = prior.ProjectionAt(refined.whitened);
  JudgeControlPoints(points, projection, scale, options.max_control_point_sigmas, registration);
  if (registration.verdict == Verdict::kAccepted && points.empty()) {
    alignment.aligned = {
        prior,
        FindCandidateSamples(refined.samples,
                             evidence,
                             prior,
                             projection,
                             0,
                             1.5 * options.joint.start_range_px,
                             options.joint.matching),
        refined.whitened,
        refined.noise_px,
        FindScoreSamples(
            refined.samples, projection, evidence, options.joint.start_range_px, options.score),
        rival_nats,
        rival.distance_px / scale};
  }
  return alignment;
}

void FinishVerdict(const RegisterOptions& options, PhotographAlignment& alignment) {
  Registration& registration = alignment.registration;
  if (HasCorrection(registration.verdict)) {
    JudgeCertainty(options.max_vertex_sigma_px, registration);
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
