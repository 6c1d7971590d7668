// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/camera/control_points.h"
#include "register/edges/aligned_sample.h"
#include "register/edges/edge_evidence.h"
#include "register/edges/edge_matches.h"
#include "register/edges/edge_residuals.h"
#include "register/edges/edge_samples.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

struct RefineOptions {
  // The search range starts at this share of the prior's 3 sigma and shrinks by this factor a
  // step, down to matching.final_range_px.
  double start_sigmas = 0.25;
  double shrink = 0.6;
  // How dense the edges are sampled, and how far from the frame's border they stay.
  double spacing_px = 4;
  double border_px = 3;
  MatchOptions matching;
  EdgeBias bias;
  // The least noise of an edge's position that is believed, px.
  double min_noise_px = 0.3;
  // Fewer matched samples than this say nothing.
  int min_matched = 8;
  // Steps at the final range: the mixture settles in a few. The solver's iterations in a step of
  // the annealing, and in one of these; and the relative change of its cost at which it stops.
  int num_final_steps = 3;
  int annealing_iterations = 3;
  int final_iterations = 5;
  double function_tolerance = 1e-8;
  // Between the last two steps a settled solution moves by less than this share of its own
  // uncertainty.
  double settled_sigmas = 0.5;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "refine options: ") const;
};

// What refinement found from one start.
struct Refinement {
  // How far it came.
  enum class Outcome {
    kConverged,
    kNotSettled,    // the last steps still moved it
    kNoCovariance,  // a camera, but how certain it is could not be computed
    kNoSolution,    // the solver found none in the last step
    kTooFewEdges,   // fewer than min_matched samples were matched
  };
  Outcome outcome = Outcome::kTooFewEdges;
  CameraParameters whitened = CameraParameters::Zero();
  // Of the whitened parameters, with model bias and residual spread included. Without a covariance
  // (kNoCovariance and below) it is the prior's.
  CameraCovariance covariance = CameraCovariance::Identity();
  std::vector<EdgeSample> samples;        // as visible from the refined camera
  int num_matched = 0;                    // samples with a match
  std::vector<SampleResidual> residuals;  // of these, as the refined camera sees them
  // The spread as the solver takes it, within the bounds that are believed.
  double noise_px = 1;
};

// Aligns the model's edges with the photograph's, from a start in whitened parameters: edge
// candidates as a robust mixture whose width is annealed with the search range (graduated
// non-convexity), the prior as residuals, each model edge with a marginalised offset. Control
// points, in pixels of the prior's picture, join the solve as residuals.
Refinement RefinePhotograph(const CameraParameters& start,
                            const EdgeModel& edge_model,
                            const EdgeEvidence& evidence,
                            const CameraPrior& prior,
                            const RefineOptions& options,
                            const std::vector<ControlPoint>& points = {});

// The same without some of the model's edges: is_left_out, for each of them.
Refinement RefineWithoutEdges(const CameraParameters& start,
                              const EdgeModel& edge_model,
                              const std::vector<bool>& is_left_out,
                              const EdgeEvidence& evidence,
                              const CameraPrior& prior,
                              const RefineOptions& options);

}  // namespace groundglass
