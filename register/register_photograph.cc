// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/register_photograph.h"

#include "register/find_solutions.h"
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

  const CameraPrior prior =
      MakeCameraPrior(measured, width_px, height_px, edge_model.model.unit, lens, options.prior);
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

  registration.score_nats = best.score.nats;
  registration.margin_nats =
      rival.solution ? best.TotalScore() - rival.solution->TotalScore() : 1e6;
  WriteSolution({refined.whitened, refined.covariance, refined.noise_px, refined.num_matched},
                prior,
                edge_model.model,
                PointsOf(refined.samples),
                registration);
  JudgeFit(best, rival.solution, rival.distance_px / scale, options, registration);
  JudgeChange(refined.whitened, prior, options, registration);
  const ParameterProjection projection = prior.ProjectionAt(refined.whitened);
  JudgeControlPoints(points, projection, scale, options.max_control_point_sigmas, registration);
  if (registration.verdict == Verdict::kAccepted && points.empty()) {
    alignment.aligned = {prior,
                         FindCandidateSamples(refined.samples,
                                              evidence,
                                              prior,
                                              projection,
                                              0,
                                              1.5 * options.joint.start_range_px,
                                              options.joint.matching),
                         refined.whitened,
                         refined.noise_px};
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
