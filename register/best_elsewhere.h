// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/joint/aligned_photograph.h"
#include "register/verdict/verdict.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace groundglass {

// A camera that a photograph found by itself, and what its edges and its tag say for it in all.
struct CameraAlone {
  CameraParameters whitened = CameraParameters::Zero();
  double nats = 0;
};

// Of the cameras that a photograph found by itself, the best one that lies elsewhere than the one
// from the common solution, and how much more speaks for that one, nats; none if all lie there.
struct BestElsewhere {
  std::optional<CameraParameters> camera;  // whitened
  double lead_nats = 0;
  double distance_px = 0;  // from the common solution's, px of the prior's picture
};

// photograph: with the common solution's camera, for which its edges and its tag say `nats`; alone:
// the camera with which it came into it. Two cameras are the same place within distinct_px, px at a
// width of 1200, on average where the photograph sees the model (points_in_world).
BestElsewhere FindBestElsewhere(const AlignedPhotograph& photograph,
                                double nats,
                                const CameraAlone& alone,
                                const std::vector<Eigen::Vector3d>& points_in_world,
                                double distinct_px);

// How much of the square of the way to it a claim takes in, so that it covers both cameras: half
// where edges say as much for it, none where they say least_margin_nats less, never more than all.
double ShareOfElsewhere(double margin_nats, double least_margin_nats);

// Where edges do not tell a camera from another that is as near as cameras must be known, this is
// no question of which but of how well: what is claimed covers both, and says so in the evidence.
// distance_px: between them, at a width of 640; covariance: of the whitened parameters.
void CoverBoth(const CameraParameters& whitened,
               const CameraParameters& elsewhere,
               double distance_px,
               const VerdictOptions& options,
               Evidence& evidence,
               CameraCovariance& covariance);

}  // namespace groundglass
