// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/best_elsewhere.h"

#include "register/camera/mean_displacement.h"

#include <algorithm>

namespace groundglass {

BestElsewhere FindBestElsewhere(const AlignedPhotograph& photograph,
                                double nats,
                                const CameraAlone& alone,
                                const std::vector<Eigen::Vector3d>& points_in_world,
                                double distinct_px) {
  const ParameterProjection here = photograph.prior.ProjectionAt(photograph.whitened);
  std::vector<CameraAlone> found = {alone};
  if (photograph.second_best_nats) {
    found.push_back({photograph.second_best_whitened,
                     *photograph.second_best_nats + photograph.log_probability});
  }
  BestElsewhere best;
  double most_nats = 0;
  for (const CameraAlone& camera : found) {
    const double distance_px =
        MeanDisplacementPx(points_in_world, here, photograph.prior.ProjectionAt(camera.whitened));
    if (distance_px <= distinct_px * photograph.prior.width_px / 1200.0) continue;
    if (best.camera && camera.nats <= most_nats) continue;
    most_nats = camera.nats;
    best.camera = camera.whitened;
    best.distance_px = distance_px;
  }
  best.lead_nats = nats - most_nats;
  return best;
}

double ShareOfElsewhere(double margin_nats, double least_margin_nats) {
  return std::clamp(0.5 * (1 - margin_nats / least_margin_nats), 0.0, 1.0);
}

void CoverBoth(const CameraParameters& whitened,
               const CameraParameters& elsewhere,
               double distance_px,
               const VerdictOptions& options,
               Evidence& evidence,
               CameraCovariance& covariance) {
  const double least_margin = LeastMargin(evidence.score, options);
  if (!evidence.margin_nats || *evidence.margin_nats >= least_margin) return;
  if (distance_px > options.max_vertex_sigma_px) return;
  evidence.claim_covers_both = true;
  const CameraParameters apart = elsewhere - whitened;
  covariance += ShareOfElsewhere(*evidence.margin_nats, least_margin) * apart * apart.transpose();
}

}  // namespace groundglass
