// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/edges/edge_evidence.h"
#include "register/edges/edge_samples.h"

#include <string>
#include <vector>

namespace groundglass {

struct HypothesisOptions {
  // How far from the prior's mean to look, in its standard deviations.
  double reach_sigmas = 3;
  // Resolution of the search: the frame's width in cells.
  int width_cells = 320;
  // Steps of the grid, in cells, root mean square over the edge samples.
  double step_cells = 2.5;
  // At most this many grid points; the step grows to fit.
  int max_grid_points = 60000;
  // Distinct starts to return, besides the tag itself.
  int max_starts = 8;
  // Starts nearer than this to a better one are the same, in cells.
  double distinct_cells = 1.5;
  // The search moves the edges linearly, and moves those that its centre sees. Where the prior is
  // so wide that their true paths bend by more than a step of the grid, and the best solution
  // scores below this for each independent observation, the search begins anew about the best
  // solutions, with half the reach each time.
  double again_below_nats_per_observation = 0.5;
  int max_rounds = 4;
  int num_centres = 3;
  // Edge that counts as one independent observation.
  double observation_length_px = 20;
  // The maps of the photograph's edges: how many orientations they tell apart, and how far an edge
  // is spread in them, one standard deviation, for the grid (in its steps) and for the climb.
  int num_orientations = 8;
  double grid_blur_steps = 1 / 1.5;
  double climb_blur_cells = 1;
  // Where the grid has too many points its steps grow by this factor until it fits. Its corners
  // may lie this much farther out than reach_sigmas.
  double step_growth = 1.15;
  double corner_reach = 1.1;
  // The best points of the grid that lie this many steps apart climb, this many for each start.
  double climb_distinct_steps = 1.2;
  int climbs_per_start = 6;
  // Steps of the climb are halved down to this, with so many rounds each; a direction that moves
  // the edges by less than a step within so many standard deviations is left alone.
  double least_climb_step_cells = 0.4;
  int climb_rounds = 3;
  double climb_reach_sigmas = 3;
  // Share of a model edge that the photograph shows.
  double shown_share = 0.65;
  // Gradients weaker than this are noise, and one of the second counts half; in units of the
  // cells' noise (EdgeEvidence::Level).
  double min_gradient = 1.5;
  double half_weight_gradient = 6;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "hypothesis options: ") const;
};

// A start for refinement: whitened parameters (CameraPrior) and its coarse log score.
struct Hypothesis {
  CameraParameters whitened = CameraParameters::Zero();
  double score = 0;
};

// Scores the prior's leading image-space directions (mostly shift, turn and scale) on a grid over
// orientation-binned soft gradient maps at low resolution, climbs from the best points, and
// returns the best distinct ones, best first, the tag itself (all zero) last.
std::vector<Hypothesis> FindHypotheses(const std::vector<EdgeSample>& samples,
                                       const CameraPrior& prior,
                                       const EdgeEvidence& evidence,
                                       const HypothesisOptions& options);

// How far the edges' true paths bend away from the straight ones that the search takes: the part
// that grows with the square of the parameters, at two standard deviations, root mean square, px.
double PriorNonlinearity(const std::vector<EdgeSample>& samples, const CameraPrior& prior);

}  // namespace groundglass
