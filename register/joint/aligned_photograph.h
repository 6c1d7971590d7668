// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/camera/camera_prior.h"
#include "register/edges/edge_matches.h"
#include "register/search/score.h"
#include "register/ties/tie_points.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// One photograph as it was aligned by itself, with what it offers about the camera found.
struct AlignedPhotograph {
  CameraPrior prior;                   // of the reading of its tag that fits (TagReading)
  std::vector<CandidateSample> found;  // sorted by edge
  std::shared_ptr<const TiePicture> picture = {};
  FollowedPhotograph followed = {};
  CameraParameters whitened = CameraParameters::Zero();
  double noise_px = 1;  // spread of the matched residuals, within the bounds that are believed
  // For scoring the camera that comes out: where the samples are seen, and how much the best
  // solution elsewhere scores in all; none: nothing.
  std::vector<ScoreSample> score_samples = {};
  std::vector<ScoreSample> conflict_samples = {};  // the same, for FindEdgeConflict
  int width_px = 0;                                // of the picture in which the samples are seen
  std::optional<double> second_best_nats = {};
  CameraParameters second_best_whitened = CameraParameters::Zero();
  // How its tag was read (TagReading), and the prior from it as it was written.
  std::string slip = {};
  double log_probability = 0;
  CameraPrior written;
  // What joins the covariance of its parameters, since of two parts of the model either may be the
  // misplaced one (FindDisplacedGroups).
  CameraCovariance doubt = CameraCovariance::Zero();
};

}  // namespace groundglass
