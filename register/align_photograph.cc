// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/align_photograph.h"

#include "register/best_elsewhere.h"
#include "register/fill_registration.h"
#include "register/keep_stages.h"
#include "register/shared_conflict.h"
#include "scene/error.h"
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

// The registration of a photograph of which nothing is known but its tag.
Registration StartRegistration(const PhotographInput& photograph) {
  Registration registration;
  registration.name = photograph.name;
  registration.width_px = photograph.grey8.width;
  registration.height_px = photograph.grey8.height;
  registration.measured = photograph.measured;
  registration.corrected = photograph.measured;
  return registration;
}

// The size at which a photograph is registered. The parameters are angles and shares of the frame,
// so it does not enter them.
struct WorkingSize {
  double scale = 1;  // pixels of the working picture for one of the photograph
  int width_px = 0;
  int height_px = 0;
};

WorkingSize FindWorkingSize(const Image8& grey8, int max_width_px) {
  WorkingSize size;
  size.scale = std::min(1.0, static_cast<double>(max_width_px) / grey8.width);
  size.width_px = static_cast<int>(std::lround(grey8.width * size.scale));
  size.height_px = static_cast<int>(std::lround(grey8.height * size.scale));
  return size;
}

// The photograph and its mask at the size at which it is registered.
struct WorkingPicture {
  Image8 grey8;
  Image8 ignore;
};

WorkingPicture Reduced(const PhotographInput& photograph, const WorkingSize& size) {
  if (size.width_px == photograph.grey8.width) return {photograph.grey8, photograph.ignore};
  return {ReducedInLight(photograph.grey8, size.width_px, size.height_px),
          ResizedMask(photograph.ignore, size.width_px, size.height_px)};
}

// The camera of a solution, as it is written.
ViewTag TagOf(const TagReading& reading, const Solution& solution) {
  return TagFromParameters(reading.prior.ParametersAt(solution.refinement.whitened),
                           reading.prior.measured);
}

// What refining a photograph together with others needs of one of its cameras.
AlignedPhotograph Align(const TagReading& reading,
                        const Solution& solution,
                        const Rival& rival,
                        const CameraPrior& written,
                        const std::shared_ptr<const TiePicture>& picture,
                        const EdgeEvidence& evidence,
                        const std::vector<Eigen::Vector3d>& edge_moves_in_world,
                        const WorkingSize& size,
                        const RegisterOptions& options) {
  const Refinement& refined = solution.refinement;
  const ParameterProjection projection = reading.prior.ProjectionAt(refined.whitened);
  AlignedPhotograph aligned;
  aligned.prior = reading.prior;
  aligned.written = written;
  aligned.slip = reading.slip;
  aligned.log_probability = reading.log_probability;
  aligned.picture = picture;
  aligned.found = FindCandidateSamples(refined.samples,
                                       evidence,
                                       reading.prior,
                                       projection,
                                       0,
                                       options.joint.spare_range * options.joint.start_range_px,
                                       options.joint.matching);
  aligned.whitened = refined.whitened;
  aligned.noise_px = refined.noise_px;
  const auto score_samples = [&](double spare_px) {
    return FindScoreSamples(
        refined.samples, projection, evidence, spare_px, options.solutions.score);
  };
  aligned.width_px = size.width_px;
  aligned.score_samples = score_samples(options.joint.start_range_px);
  aligned.conflict_samples = score_samples(options.joint.start_range_px +
                                           ConflictReachPx(size.width_px, options.conflict));
  // From here on as the model draws them.
  aligned.score_samples = WithEdgesMoved(aligned.score_samples, edge_moves_in_world, -1);
  aligned.conflict_samples = WithEdgesMoved(aligned.conflict_samples, edge_moves_in_world, -1);
  if (!edge_moves_in_world.empty()) {
    for (CandidateSample& found : aligned.found) {
      found.sample.point_in_world -= edge_moves_in_world[found.sample.edge];
    }
  }
  if (rival.solution != nullptr) {
    aligned.second_best_nats = rival.total_score;
    aligned.second_best_whitened = reading.prior.WhitenedAt(
        rival.reading->prior.ParametersAt(rival.solution->refinement.whitened));
  }
  return aligned;
}

// Why the stages could not be kept; empty if they were, or nobody asked.
std::string KeepIfAsked(const AlignmentStages& stages, const RegisterOptions& options) {
  if (options.keep_folder.empty()) return "";
  try {
    KeepStages(stages, options.solutions, options.keep_folder);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

PhotographAlignment AlignPhotograph(const PhotographInput& photograph,
                                    const EdgeModel& edge_model,
                                    const RegisterOptions& options) {
  options.Check();
  PhotographAlignment alignment;
  Registration& registration = alignment.registration;
  registration = StartRegistration(photograph);

  // What is known before the photograph is looked at, and what it shows.
  const WorkingSize size = FindWorkingSize(photograph.grey8, options.max_width_px);
  const WorkingPicture picture = Reduced(photograph, size);
  const EdgeEvidence evidence(picture.grey8, picture.ignore);
  const PriorOptions prior_options = PriorSuitedTo(edge_model.model, options.prior);
  const auto prior_of = [&](const ViewTag& tag) {
    return MakeCameraPrior(
        tag, size.width_px, size.height_px, edge_model.model.unit, photograph.lens, prior_options);
  };
  const CameraPrior written = prior_of(photograph.measured);
  registration.prior_sigmas = written.sigmas;
  registration.sigmas = written.sigmas;
  const std::vector<ControlPoint> points =
      PointsIn(photograph.name, options.control_points, size.scale);

  // The cameras that fit, the best, and the best one elsewhere.
  const std::vector<TagReading> readings = ReadTag(edge_model,
                                                   evidence,
                                                   written,
                                                   prior_of,
                                                   photograph.other_tags,
                                                   points,
                                                   options.solutions,
                                                   options.readings);
  if (readings.empty()) {
    alignment.keep_fault = KeepIfAsked(
        {photograph.name, photograph.grey8, edge_model, written, evidence, {}}, options);
    registration.reasons.push_back("the measured tag sees almost nothing of the model");
    registration.covariance = written.root * written.root.transpose();
    return alignment;
  }
  const TagReading& reading = readings.front();
  alignment.keep_fault = KeepIfAsked(
      {photograph.name, photograph.grey8, edge_model, reading.prior, evidence, reading.solutions},
      options);
  const Solution& best = reading.solutions.front();
  const Refinement& refined = best.refinement;
  const Rival rival = FindRival(readings, options.solutions);
  Evidence support{best.score, {}, rival.distance_px / size.scale, !points.empty()};
  CameraCovariance covariance = refined.covariance;
  if (rival.solution != nullptr) {
    support.margin_nats = best.TotalScore() - rival.total_score;
    support.second_best = TagOf(*rival.reading, *rival.solution);
    const CameraParameters elsewhere = reading.prior.WhitenedAt(
        rival.reading->prior.ParametersAt(rival.solution->refinement.whitened));
    CoverBoth(refined.whitened,
              elsewhere,
              rival.distance_px * 640 / size.width_px,
              options.verdict,
              support,
              covariance);
  }
  FillRegistration({refined.whitened, covariance, refined.num_matched, refined.residuals},
                   reading.prior,
                   edge_model.model,
                   PointsOf(refined.samples),
                   registration);

  // Whether to believe it.
  registration.verdict = Verdict::kAccepted;
  RecordEvidence(support, registration);
  const ParameterProjection projection = reading.prior.ProjectionAt(refined.whitened);
  ApplyJudgement(JudgeFit(support, options.verdict), registration);
  ApplyJudgement(JudgeConvergence(refined.outcome), registration);
  const bool is_clear = registration.verdict == Verdict::kAccepted && reading.slip.empty() &&
                        !support.claim_covers_both;
  ApplyJudgement(JudgeTag(reading.prior.ParametersAt(refined.whitened),
                          written,
                          reading.slip,
                          edge_model.model.unit,
                          options.verdict),
                 registration);
  registration.undetermined = FindUndetermined(registration.sigmas, written, options.verdict);
  ApplyJudgement(JudgeControlPoints(points, projection, size.scale, options.verdict), registration);
  if (!points.empty()) return alignment;
  alignment.total_nats = best.TotalScore() + reading.log_probability;
  if (!HasCorrection(registration.verdict)) return alignment;
  if (photograph.asks_for_groups) {
    alignment.group_profiles = FindGroupProfiles(
        best, edge_model, evidence, reading.prior, options.solutions, options.displaced.profile);
  }
  alignment.is_clear = is_clear;
  const auto tie_picture =
      std::make_shared<const TiePicture>(picture.grey8, picture.ignore, options.ties.num_levels);
  const std::vector<Eigen::Vector3d> edge_moves_in_world = edge_model.MovesInWorld();
  const auto align = [&](const TagReading& of, const Solution& solution, const Rival& elsewhere) {
    return Align(of,
                 solution,
                 elsewhere,
                 written,
                 tie_picture,
                 evidence,
                 edge_moves_in_world,
                 size,
                 options);
  };
  alignment.aligned = align(reading, best, rival);
  alignment.conflict = FindConflictOf(alignment.aligned, edge_moves_in_world, edge_model, options);
  if (registration.verdict == Verdict::kReview && rival.solution != nullptr) {
    const double best_as_rival =
        best.TotalScore() + reading.log_probability - rival.reading->log_probability;
    alignment.second_best =
        align(*rival.reading, *rival.solution, {&reading, &best, rival.distance_px, best_as_rival});
  }
  return alignment;
}

void FinishVerdict(const RegisterOptions& options, PhotographAlignment& alignment) {
  Registration& registration = alignment.registration;
  if (HasCorrection(registration.verdict)) {
    ApplyJudgement(JudgePrecision(registration, options.verdict), registration);
  }
  OverruleVerdict(options.overrule, registration);
  if (registration.verdict == Verdict::kRejected) registration.corrected = registration.measured;
  // Whom the verdict settles has no rival.
  if (registration.verdict != Verdict::kReview) registration.rival.reset();
}

}  // namespace groundglass
