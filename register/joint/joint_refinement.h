// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/edges/aligned_sample.h"
#include "register/edges/edge_matches.h"
#include "register/edges/residual_spread.h"
#include "register/search/score.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// One photograph as it was aligned by itself, with what it offers about the camera found.
struct AlignedPhotograph {
  CameraPrior prior;
  std::vector<CandidateSample> found;  // sorted by edge
  CameraParameters whitened = CameraParameters::Zero();
  double noise_px = 1;  // spread of the matched residuals, within the bounds that are believed
  // For scoring the camera that comes out: where the samples are seen, and how much the best
  // solution elsewhere scores in all, and how far away it lies; no rival: nothing.
  std::vector<ScoreSample> score_samples = {};
  std::optional<double> rival_nats = {};
  double rival_distance_px = 0;  // of the photograph itself
};

// Lengths are in units of the model's sigma (ModelSigma): 0.03 m for a building.
struct JointOptions {
  // What a model edge lies off in all photographs alike: of its shift as a whole, and of its ends
  // apart from that. The scale of a distribution with long tails (Cauchy), since most edges are
  // where the model has them and a few are far away.
  double common_offset_sigmas = 1;
  double common_turn_sigmas = 1;
  double widest_offset_sigmas = 10;  // one sigma of a normal distribution that ends the tails
  // How far the ground lies above or below the model's lowest level, everywhere alike, one sigma.
  // Soil does not follow a model, however well surveyed: counted in no less than the model's
  // default sigma.
  double ground_level_sigmas = 0.1 / 0.03;
  // What is seen of an edge in one photograph only (light, blur, a joint on its sunny side). Long
  // tails here too: Student's t. The size of both parts is found in each scene, between the least
  // and the most: that of the own part from what is left of each edge, that of the shared one as
  // the upper quartile of the displacements.
  EdgeBias own = {0.4, 0.4, 1};
  double own_degrees_of_freedom = 3;
  double least_own_offset_sigmas = 0.002 / 0.03;
  double most_own_offset_sigmas = 0.05 / 0.03;
  double least_shared_offset_sigmas = 0.01 / 0.03;
  double most_shared_offset_sigmas = 0.05 / 0.03;
  // The part of a prior's variance that is the photograph's own; the rest is its lens', and the
  // same for all photographs of that lens. Slides have a scale and an aspect of their own.
  double own_k1_share = 0.001;
  double own_view_angle_share = 1;
  double own_aspect_share = 1;
  // How often candidates are chosen anew, and how far from an edge: it shrinks by this factor a
  // round, down to matching.final_range_px. A loose model (EdgeSample::looseness) widens both.
  int num_rounds = 6;
  double start_range_px = 6;
  // Candidates are kept this many times as far away, since the camera moves while they are matched.
  double spare_range = 1.5;
  double shrink = 0.6;
  double min_noise_px = 0.3;
  MatchOptions matching = {.final_range_px = 1.2};

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "joint options: ") const;
};

// How far a model edge was found from where the model has it.
struct EdgeDisplacement {
  int edge = -1;  // in EdgeModel::edges
  // Of the edge's two ends, across it, model's unit.
  Eigen::Vector3d start_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_in_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of the edge's middle
  int num_photographs = 0;                               // that show it
};

struct JointSolution {
  CameraParameters whitened = CameraParameters::Zero();
  CameraCovariance covariance = CameraCovariance::Identity();  // of the whitened parameters
  int num_matched = 0;
  // Of the matched samples about the model's edges as the model has them.
  std::optional<ResidualSpread> spread = {};
};

struct JointRefinement {
  std::vector<JointSolution> photographs;       // in the order given
  std::vector<EdgeDisplacement> displacements;  // in order of edge
};

// Solves all photographs together: cameras with their priors, the lens that photographs share, and
// where each model edge really is, so that a cornice that the model has a hand too low drags no
// camera. Starts are the photographs' own solutions. lenses: for each photograph, the number of its
// lens, from 0. Deterministic. Throws Error if the solver finds no solution.
JointRefinement RefineTogether(const EdgeModel& edge_model,
                               const std::vector<AlignedPhotograph>& photographs,
                               const std::vector<int>& lenses,
                               const JointOptions& options);

}  // namespace groundglass
