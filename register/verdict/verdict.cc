// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/verdict/verdict.h"

#include "scene/check_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// The parameter that the photograph narrowed least.
std::string LeastCertain(const Registration& registration) {
  int least = 0;
  double largest_share = -1;
  for (int i = 0; i < kNumCameraParameters; ++i) {
    if (!(registration.prior_sigmas[i] > 0)) continue;
    const double share = registration.sigmas[i] / registration.prior_sigmas[i];
    if (share <= largest_share) continue;
    largest_share = share;
    least = i;
  }
  return std::string(kCameraParameterNames[least]);
}

// How a camera differs from its tag, as a person would say it: "x 3.8 ft further east". change: in
// `site`.
std::string DescribeChange(CameraParameter parameter, double change, LengthUnit unit) {
  const auto say = [&](const std::string& unit_name, const char* if_more, const char* if_less) {
    return fmt::format("{} {:.3g}{} {}",
                       kCameraParameterNames[parameter],
                       std::abs(change),
                       unit_name,
                       change > 0 ? if_more : if_less);
  };
  const std::string length = " " + UnitName(unit);
  const std::string angle = " degrees";
  switch (parameter) {
    case kPositionX:
      return say(length, "further east", "further west");
    case kPositionY:
      return say(length, "further south", "further north");
    case kPositionZ:
      return say(length, "higher", "lower");
    case kYaw:
      return say(angle, "further left", "further right");
    case kPitch:
      return say(angle, "higher", "lower");
    case kRoll:
      return say(angle, "more", "less");
    case kViewAngle:
      return say(angle, "wider", "narrower");
    default:
      return say("", "more", "less");
  }
}

// Joins one more finding to a judgement.
void Add(Verdict verdict, const std::string& reason, Judgement& judgement) {
  judgement.verdict = std::max(judgement.verdict, verdict);
  judgement.reasons.push_back(reason);
}

}  // namespace

void VerdictOptions::Check(const std::string& path) const {
  CheckAtLeast(min_margin_per_observation, 0, path + "min_margin_per_observation");
  CheckAtLeast(min_margin_nats, 0, path + "min_margin_nats");
  CheckAtLeast(min_nats_per_observation, 0, path + "min_nats_per_observation");
  CheckAtLeast(min_nats, 0, path + "min_nats");
  CheckAbove(max_prior_sigmas, 0, path + "max_prior_sigmas");
  CheckAbove(max_prior_chi_squared, 0, path + "max_prior_chi_squared");
  CheckAbove(max_vertex_sigma_px, 0, path + "max_vertex_sigma_px");
  CheckAbove(min_expected_ties, 0, path + "min_expected_ties");
  CheckFromTo(min_share_of_expected_ties, 0, 1, path + "min_share_of_expected_ties");
  CheckAbove(max_control_point_sigmas, 0, path + "max_control_point_sigmas");
  CheckFromTo(undetermined_share, 0, 1, path + "undetermined_share");
}

VerdictOptions WithOverclaim(VerdictOptions options, double overclaim) {
  options.max_prior_sigmas *= overclaim;
  options.max_prior_chi_squared *= overclaim * overclaim;
  return options;
}

void ApplyJudgement(const Judgement& judgement, Registration& registration) {
  registration.verdict = std::max(registration.verdict, judgement.verdict);
  registration.reasons.insert(
      registration.reasons.end(), judgement.reasons.begin(), judgement.reasons.end());
}

double LeastMargin(const AlignmentScore& score, const VerdictOptions& options) {
  return std::max(options.min_margin_nats, options.min_margin_per_observation * score.observations);
}

Judgement JudgeFit(const Evidence& evidence, const VerdictOptions& options) {
  Judgement judgement;
  const AlignmentScore& score = evidence.score;
  if (score.nats <= 0) {
    Add(Verdict::kRejected,
        fmt::format("the model's edges meet the photograph's no better than by chance "
                    "(score {:.0f} nats)",
                    score.nats),
        judgement);
  }
  if (score.nats > 0 && score.nats < options.min_nats && !evidence.has_control_points &&
      score.nats + evidence.tie_nats < options.min_nats) {
    Add(Verdict::kRejected,
        fmt::format(
            "the photograph says next to nothing about its camera (score {:.1f} nats; chance finds "
            "a place with up to {:.0f})",
            score.nats,
            options.min_nats),
        judgement);
  }
  // What stands against a camera of few edges, where other photographs do not confirm it.
  const double nats_per_observation =
      (score.nats + std::max(0.0, evidence.tie_nats)) / std::max(1.0, score.observations);
  if (score.nats > 0 && nats_per_observation < options.min_nats_per_observation) {
    Add(Verdict::kReview,
        fmt::format("few of the model's edges are in the photograph ({:.2f} nats an observation)",
                    nats_per_observation),
        judgement);
  }
  if (evidence.margin_nats && *evidence.margin_nats < LeastMargin(score, options) &&
      !evidence.claim_covers_both) {
    Add(Verdict::kReview,
        fmt::format("another camera {:.1f} px away fits almost as well (margin {:.0f} nats)",
                    evidence.second_best_distance_px,
                    *evidence.margin_nats),
        judgement);
  }
  return judgement;
}

Judgement JudgeConvergence(Refinement::Outcome outcome) {
  switch (outcome) {
    case Refinement::Outcome::kConverged:
      return {};
    case Refinement::Outcome::kNotSettled:
      return {Verdict::kReview, {"refinement did not settle"}};
    case Refinement::Outcome::kNoCovariance:
      return {Verdict::kReview,
              {"how certain the camera is could not be computed; the uncertainty that is given is "
               "the tag's own"}};
    case Refinement::Outcome::kNoSolution:
      return {Verdict::kRejected, {"the solver found no camera that can be used"}};
    case Refinement::Outcome::kTooFewEdges:
      return {Verdict::kReview,
              {"too few of the model's edges are found in the photograph; the uncertainty that is "
               "given is the tag's own"}};
  }
  return {};
}

Judgement JudgeInnovation(const CameraParameters& parameters,
                          const CameraPrior& written,
                          LengthUnit unit,
                          const VerdictOptions& options) {
  Judgement judgement;
  const CameraParameters whitened = written.WhitenedAt(parameters);
  const CameraParameters change = SiteChange(written.root * whitened);
  std::string differs;
  std::string times;
  for (int i = 0; i < kNumCameraParameters; ++i) {
    if (!(written.sigmas[i] > 0)) continue;
    const double sigmas = std::abs(change[i]) / written.sigmas[i];
    if (sigmas <= options.max_prior_sigmas) continue;
    const char* separator = differs.empty() ? "" : ", ";
    differs += separator + DescribeChange(static_cast<CameraParameter>(i), change[i], unit);
    times += separator + fmt::format("{:.1f}", sigmas);
  }
  if (!differs.empty()) {
    Add(Verdict::kReview,
        "other than written: " + differs + "; " + times + " times what the tag's sigmas claim",
        judgement);
    return judgement;
  }
  const double chi_squared = whitened.squaredNorm();
  if (chi_squared > options.max_prior_chi_squared) {
    Add(Verdict::kReview,
        fmt::format("the change as a whole is larger than the tag's sigmas allow "
                    "(chi-squared {:.0f} of 11)",
                    chi_squared),
        judgement);
  }
  return judgement;
}

Judgement JudgeTag(const CameraParameters& parameters,
                   const CameraPrior& written,
                   const std::string& slip,
                   LengthUnit unit,
                   const VerdictOptions& options) {
  if (slip.empty()) return JudgeInnovation(parameters, written, unit, options);
  return {Verdict::kReview, {"the photograph does not fit its tag as written, but with " + slip}};
}

Judgement JudgeDisagreement() {
  return {Verdict::kReview,
          {"its own edges and the other photographs do not agree on one camera; the one that its "
           "own edges say is given"}};
}

Judgement JudgeTies(const Registration::Ties& ties,
                    const Registration::Ties& all,
                    const VerdictOptions& options) {
  const double others_share = static_cast<double>(all.num_agreeing - ties.num_agreeing) /
                              std::max(1, all.num_tried - ties.num_tried);
  const double expected = others_share * ties.num_tried;
  if (expected < options.min_expected_ties) return {};
  if (ties.num_agreeing >= options.min_share_of_expected_ties * expected) return {};
  return {Verdict::kReview,
          {fmt::format("other photographs do not confirm its camera: of {} places that they could "
                       "share, {} agree, where {:.0f} should by what they share with one another",
                       ties.num_tried,
                       ties.num_agreeing,
                       expected)}};
}

Judgement JudgeConflict(const EdgeConflict& conflict, int num_alike, int num_photographs) {
  return {Verdict::kReview,
          {fmt::format("{} fit better {:.1f} px from where the rest of the model puts them (by "
                       "{:.0f} nats), and so in {} of {} photographs: one part of the model is "
                       "misplaced against the other",
                       conflict.is_of_coplanar_edges ? "windows and other lines within walls"
                                                     : "the building's outlines and corners",
                       conflict.distance_px,
                       conflict.gain_nats,
                       num_alike,
                       num_photographs)}};
}

Judgement JudgePrecision(const Registration& registration, const VerdictOptions& options) {
  const double to_640 = 640.0 / registration.width_px;
  if (registration.vertex_sigma_px * to_640 <= options.max_vertex_sigma_px) return {};
  return {Verdict::kReview,
          {fmt::format("the model's points are known to {:.1f} px only; {} is the least certain",
                       registration.vertex_sigma_px,
                       LeastCertain(registration))}};
}

Judgement JudgeControlPoints(const std::vector<ControlPoint>& points,
                             const ParameterProjection& projection,
                             double scale,
                             const VerdictOptions& options) {
  Judgement judgement;
  for (const ControlPoint& point : points) {
    const Eigen::Vector2d at = point.image_px / scale;
    const auto seen_px = projection.ImageOf(point.point_in_world);
    if (!seen_px) {
      Add(Verdict::kReview,
          fmt::format("the control point at {:.0f} {:.0f} is behind the camera", at.x(), at.y()),
          judgement);
      continue;
    }
    const double distance_px = (*seen_px - point.image_px).norm();
    if (distance_px <= options.max_control_point_sigmas * point.sigma_px) continue;
    Add(Verdict::kReview,
        fmt::format(
            "the control point at {:.0f} {:.0f} is seen {:.1f} px away, {:.1f} of its sigmas",
            at.x(),
            at.y(),
            distance_px / scale,
            distance_px / point.sigma_px),
        judgement);
  }
  return judgement;
}

std::vector<std::string> FindUndetermined(const CameraParameters& sigmas,
                                          const CameraPrior& prior,
                                          const VerdictOptions& options) {
  std::vector<std::string> names;
  for (int i = 0; i < kNumCameraParameters; ++i) {
    if (prior.sigmas[i] > 0 && sigmas[i] > options.undetermined_share * prior.sigmas[i]) {
      names.emplace_back(kCameraParameterNames[i]);
    }
  }
  return names;
}

}  // namespace groundglass
