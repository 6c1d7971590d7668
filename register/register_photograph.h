// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera_prior.h"
#include "register/control_points.h"
#include "register/edge_samples.h"
#include "register/hypotheses.h"
#include "register/joint_refinement.h"
#include "register/model_errors.h"
#include "register/overrule.h"
#include "register/refine.h"
#include "register/score.h"
#include "scene/image.h"
#include "scene/lens.h"
#include "scene/registration.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

struct RegisterOptions {
  PriorOptions prior;
  HypothesisOptions hypotheses;
  RefineOptions refine;
  ScoreOptions score;
  JointOptions joint;
  ModelErrorOptions model_errors;
  // Each photograph by itself; else those that are accepted are refined together.
  bool independent = false;

  // Photographs wider than this are registered at this width, their light averaged: edges of
  // buildings are no sharper.
  int max_width_px = 1600;
  // A solution this far from the best one is another solution, px at a width of 1200.
  double rival_distance_px = 2.5;
  // The best solution must score this much above its best rival for each vote that was cast, and
  // this much in all, nats.
  double min_margin_per_vote = 0.15;
  double min_margin_nats = 20;
  // The best solution must score at least this for each vote that was cast (docs/accuracy.md).
  double min_nats_per_vote = 0.2;
  // No parameter may end further than this from its prior, in the prior's sigmas.
  double max_prior_sigmas = 3.5;
  // Nor may all of them together: the squared length of the whitened change (chi-squared with 11
  // degrees of freedom; 99.9 % lie below).
  double max_prior_chi_squared = 31.3;

  // Nor may the model's points be known worse than this, px at a width of 640.
  double max_vertex_sigma_px = 2;

  // Places that a person has recognised, of all photographs, in pixels of theirs. None may end
  // further than this from where the camera sees it, in the point's sigmas.
  std::vector<ControlPoint> control_points;
  double max_control_point_sigmas = 4;

  // Whose verdicts a person decides.
  OverruleOptions overrule;

  void Check() const;  // throws Error naming the first field out of range
};

// A photograph that was aligned by itself, with what refining it together with others needs. Its
// verdict does not heed yet how certain the camera is (FinishVerdict).
struct PhotographAlignment {
  Registration registration;
  AlignedPhotograph aligned;  // empty unless the verdict is `accepted`
};

// Corrects one photograph's tag against the model's edges.
// grey8: the photograph, 1 channel. ignore: same size, non-zero where it is no evidence; may be
// empty. Not converging is a result (verdict, reasons), not an error.
PhotographAlignment AlignPhotograph(const std::string& name,
                                    const Image8& grey8,
                                    const Image8& ignore,
                                    const ViewTag& measured,
                                    const std::optional<Lens>& lens,
                                    const EdgeModel& edge_model,
                                    const RegisterOptions& options);

// The last word on a photograph: `review` where it stays uncertain, and what a person decides.
void FinishVerdict(const RegisterOptions& options, PhotographAlignment& alignment);

// AlignPhotograph for a photograph that stays alone, with its verdict finished.
Registration RegisterPhotograph(const std::string& name,
                                const Image8& grey8,
                                const Image8& ignore,
                                const ViewTag& measured,
                                const std::optional<Lens>& lens,
                                const EdgeModel& edge_model,
                                const RegisterOptions& options);

}  // namespace groundglass
