// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/edges/aligned_sample.h"
#include "register/edges/edge_matches.h"
#include "register/edges/residual_spread.h"
#include "register/joint/joint_options.h"
#include "register/search/score.h"
#include "register/ties/tie_points.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// One photograph as it was aligned by itself, with what it offers about the camera found.
struct AlignedPhotograph {
  CameraPrior prior;
  std::vector<CandidateSample> found;  // sorted by edge
  std::shared_ptr<const TiePicture> picture = {};
  FollowedPhotograph followed = {};
  CameraParameters whitened = CameraParameters::Zero();
  double noise_px = 1;  // spread of the matched residuals, within the bounds that are believed
  // For scoring the camera that comes out: where the samples are seen, and how much the best
  // solution elsewhere scores in all, and how far away it lies; none: nothing.
  std::vector<ScoreSample> score_samples = {};
  std::optional<double> second_best_nats = {};
  CameraParameters second_best_whitened = CameraParameters::Zero();
  double second_best_distance_px = 0;  // of the photograph itself
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
// lens, from 0. ties: what photographs see alike, by their numbers here; may be empty.
// Deterministic. Throws Error if the solver finds no solution.
JointRefinement RefineTogether(const EdgeModel& edge_model,
                               const std::vector<AlignedPhotograph>& photographs,
                               const std::vector<int>& lenses,
                               const std::vector<TiePoint>& ties,
                               const JointOptions& options);

}  // namespace groundglass
