// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace groundglass {
namespace {

template <typename... Args>
std::string Format(const char* format, Args... args) {
  char text[256];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

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

void LowerTo(Verdict verdict, const std::string& reason, Registration& registration) {
  registration.verdict = std::max(registration.verdict, verdict);
  registration.reasons.push_back(reason);
}

}  // namespace

void JudgeEvidence(const Evidence& evidence,
                   const RegisterOptions& options,
                   Registration& registration) {
  const AlignmentScore& score = evidence.score;
  registration.score_nats = score.nats;
  registration.margin_nats = evidence.margin_nats;
  if (score.nats <= 0) {
    LowerTo(Verdict::kRejected,
            Format("the model's edges meet the photograph's no better than by chance "
                   "(score %.0f nats)",
                   score.nats),
            registration);
  }
  const double nats_per_vote = score.nats / std::max(1.0, score.votes);
  if (score.nats > 0 && nats_per_vote < options.min_nats_per_vote) {
    LowerTo(
        Verdict::kReview,
        Format("few of the model's edges are in the photograph (%.2f nats a vote)", nats_per_vote),
        registration);
  }
  const double min_margin_nats =
      std::max(options.min_margin_nats, options.min_margin_per_vote * score.votes);
  if (evidence.margin_nats && *evidence.margin_nats < min_margin_nats) {
    LowerTo(Verdict::kReview,
            Format("a rival %.1f px away fits almost as well (margin %.0f nats)",
                   evidence.rival_distance_px,
                   *evidence.margin_nats),
            registration);
  }
}

void JudgeOutcome(Refinement::Outcome outcome, Registration& registration) {
  switch (outcome) {
    case Refinement::Outcome::kConverged:
      return;
    case Refinement::Outcome::kNotSettled:
      return LowerTo(Verdict::kReview, "refinement did not settle", registration);
    case Refinement::Outcome::kNoCovariance:
      return LowerTo(Verdict::kReview,
                     "how certain the camera is could not be computed; the uncertainty that is "
                     "given is the tag's own",
                     registration);
    case Refinement::Outcome::kNoSolution:
      return LowerTo(
          Verdict::kRejected, "the solver found no camera that can be used", registration);
    case Refinement::Outcome::kTooFewEdges:
      return LowerTo(Verdict::kReview,
                     "too few of the model's edges are found in the photograph; the uncertainty "
                     "that is given is the tag's own",
                     registration);
  }
}

void JudgeChange(const CameraParameters& whitened,
                 const CameraPrior& prior,
                 const RegisterOptions& options,
                 Registration& registration) {
  registration.undetermined.clear();
  for (int i = 0; i < kNumCameraParameters; ++i) {
    // Less than a tenth narrower than before: this photograph says nothing about it.
    if (prior.sigmas[i] > 0 && registration.sigmas[i] > 0.9 * prior.sigmas[i]) {
      registration.undetermined.emplace_back(kCameraParameterNames[i]);
    }
  }
  const double chi_squared = whitened.squaredNorm();
  if (chi_squared > options.max_prior_chi_squared) {
    LowerTo(Verdict::kReview,
            Format("the change as a whole is larger than the tag's sigmas allow "
                   "(chi-squared %.0f of 11)",
                   chi_squared),
            registration);
  }
  const CameraParameters change = prior.root * whitened;
  for (int i = 0; i < kNumCameraParameters; ++i) {
    if (!(prior.sigmas[i] > 0)) continue;
    const double sigmas = std::abs(change[i]) / prior.sigmas[i];
    if (sigmas > options.max_prior_sigmas) {
      LowerTo(Verdict::kReview,
              Format("%s would move by %.3g, %.1f of its standard deviations",
                     kCameraParameterNames[i].data(),
                     change[i],
                     sigmas),
              registration);
    }
  }
}

void JudgeCertainty(double max_vertex_sigma_px, Registration& registration) {
  const double to_640 = 640.0 / registration.width_px;
  if (registration.vertex_sigma_px * to_640 > max_vertex_sigma_px) {
    LowerTo(Verdict::kReview,
            Format("the model's points are known to %.1f px only; %s is the least certain",
                   registration.vertex_sigma_px,
                   LeastCertain(registration).c_str()),
            registration);
  }
}

}  // namespace groundglass
