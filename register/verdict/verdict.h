// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/camera/control_points.h"
#include "register/refine/refine_photograph.h"
#include "register/search/edge_conflict.h"
#include "register/search/score.h"
#include "scene/length_unit.h"
#include "scene/registration.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// What a camera must show before it is accepted.
struct VerdictOptions {
  // The best solution must score this much above the second-best for each independent observation,
  // and this much in all, nats.
  double min_margin_per_observation = 0.15;
  double min_margin_nats = 20;
  // The best solution must score at least this for each independent observation
  // (docs/measurements/accuracy.md).
  double min_nats_per_observation = 0.2;
  // A camera whose score is less than this in all is rejected, nats. By chance alone the best of n
  // places scores about ln n, 11 for those that the search tries, and up to twice that where one
  // row of bricks is many observations (docs/measurements/accuracy.md). Does not hold where a
  // person has pointed: then the edges need not find the place.
  double min_nats = 25;
  // No parameter may end further than this from its prior, in the prior's sigmas.
  double max_prior_sigmas = 3.5;
  // Nor may all of them together: the squared length of the whitened change (chi-squared with 11
  // degrees of freedom; 99.9 % lie below).
  double max_prior_chi_squared = 31.3;
  // Nor may the model's points be known worse than this, px at a width of 640.
  double max_vertex_sigma_px = 2;
  // Where, by what the others share with one another, so many of a photograph's patches should be
  // found where its camera puts them, at least this share of them must be.
  double min_expected_ties = 8;
  double min_share_of_expected_ties = 0.1;
  // No place that a person has recognised may lie further than this from where the camera sees it,
  // in the point's sigmas.
  double max_control_point_sigmas = 4;
  // A parameter whose sigma is more than this share of its prior's is no better known than before.
  double undetermined_share = 0.9;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "verdict options: ") const;
};

// How tags are judged that err so many times more than they claim, all of them.
VerdictOptions WithOverclaim(VerdictOptions options, double overclaim);

// What one test concludes: the best verdict that it leaves possible, and why, in words.
struct Judgement {
  Verdict verdict = Verdict::kAccepted;
  std::vector<std::string> reasons;
};
// Lowers the registration's verdict to the judgement's, never raises it, and adds the reasons.
void ApplyJudgement(const Judgement& judgement, Registration& registration);

// What speaks for a camera: its score, and how much better it is than the best solution elsewhere,
// if there is one, and how far away that lies.
struct Evidence {
  AlignmentScore score;
  std::optional<double> margin_nats;
  double second_best_distance_px = 0;  // of the photograph
  bool has_control_points = false;
  double tie_nats = 0;  // how much other photographs speak for it (TieSupport)
  // The solution elsewhere is as near as cameras must be known, and what is claimed covers both.
  bool claim_covers_both = false;
  std::optional<ViewTag> second_best = {};  // the camera that margin_nats is over
};
// How much better than the second-best camera one must be, nats.
double LeastMargin(const AlignmentScore& score, const VerdictOptions& options);

// Goodness of fit: rejected where the edges fit no better than by chance, at that place or at the
// best of many, review where they fit little, or elsewhere almost as well.
Judgement JudgeFit(const Evidence& evidence, const VerdictOptions& options);

// How far the refinement came.
Judgement JudgeConvergence(Refinement::Outcome outcome);

// Innovation: review where the change from prior to solution is larger than the tag's sigmas allow,
// as a whole (chi-squared) or in one parameter. written: the prior from the tag as it was written.
// unit: the model's.
Judgement JudgeInnovation(const CameraParameters& parameters,
                          const CameraPrior& written,
                          LengthUnit unit,
                          const VerdictOptions& options);

// Review where the camera fits another reading of the tag (TagReading::slip) than the written one,
// which is the one that is judged if there is no slip (JudgeInnovation).
Judgement JudgeTag(const CameraParameters& parameters,
                   const CameraPrior& written,
                   const std::string& slip,
                   LengthUnit unit,
                   const VerdictOptions& options);

// Review where the other photographs pull a camera away from what its own edges say.
Judgement JudgeDisagreement();

// Review where a photograph shares far fewer places with others than it should: its edges may all
// fit lines beside those that are meant. all: the sums over all photographs, this one included;
// what it should share follows from what the others, of the places that they seek, find where their
// cameras put them.
Judgement JudgeTies(const Registration::Ties& ties,
                    const Registration::Ties& all,
                    const VerdictOptions& options);

// Review where two parts of the model's drawing do not agree on the camera. conflict: in pixels of
// the photograph; num_alike, num_photographs: how many of how many have one.
Judgement JudgeConflict(const EdgeConflict& conflict, int num_alike, int num_photographs);

// Precision: review where the model's points stay less certain than options.max_vertex_sigma_px.
// The last to judge: other photographs may have made them certain.
Judgement JudgePrecision(const Registration& registration, const VerdictOptions& options);

// Review where a control point lies further than options.max_control_point_sigmas from where the
// camera sees it: somebody mistyped it or pointed at something else.
// scale: pixels of the points per pixel of the photograph.
Judgement JudgeControlPoints(const std::vector<ControlPoint>& points,
                             const ParameterProjection& projection,
                             double scale,
                             const VerdictOptions& options);

// The parameters that a photograph leaves no better known than the prior, by name.
std::vector<std::string> FindUndetermined(const CameraParameters& sigmas,
                                          const CameraPrior& prior,
                                          const VerdictOptions& options);

}  // namespace groundglass
