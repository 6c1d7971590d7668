// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/fill_registration.h"

#include "register/camera/mean_displacement.h"

#include <algorithm>
#include <cmath>

namespace groundglass {

namespace {

// As many as can be told apart where they are drawn ten times enlarged.
constexpr double kResidualPieceWidths = 0.04;

double VertexSigmaPx(const PolygonModel& model,
                     const ParameterProjection& projection,
                     const CameraCovariance& covariance,
                     int width_px,
                     int height_px) {
  double sum = 0;
  int count = 0;
  for (const Eigen::Vector3d& point : model.points_in_world) {
    const auto projected = projection.Project(point);
    if (!projected) continue;
    const Eigen::Vector2d& at = projected->image_px;
    if (at.x() < 0 || at.y() < 0 || at.x() > width_px || at.y() > height_px) continue;
    const Eigen::Matrix2d spread =
        projected->jacobian * covariance * projected->jacobian.transpose();
    sum += std::sqrt(std::max(0.0, spread.trace()));
    ++count;
  }
  return count ? sum / count : 0;
}

// The sigmas of the registration's camera from its covariance, by themselves and in its pixels.
void FillSigmas(const CameraPrior& prior,
                const ParameterProjection& projection,
                const PolygonModel& model,
                Registration& registration) {
  registration.sigmas = registration.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  registration.vertex_sigma_px =
      static_cast<double>(registration.width_px) / prior.width_px *
      VertexSigmaPx(model, projection, registration.covariance, prior.width_px, prior.height_px);
}

}  // namespace

void FillRegistration(const JointSolution& solution,
                      const CameraPrior& prior,
                      const PolygonModel& model,
                      const std::vector<Eigen::Vector3d>& points_in_world,
                      Registration& registration) {
  const double to_photograph = static_cast<double>(registration.width_px) / prior.width_px;
  const ParameterProjection projection = prior.ProjectionAt(solution.whitened);
  registration.corrected = TagFromParameters(prior.ParametersAt(solution.whitened), prior.measured);
  registration.covariance = prior.root * solution.covariance * prior.root.transpose();
  registration.num_samples = solution.num_matched;
  registration.rms_px.reset();
  registration.robust_sigma_px.reset();
  if (const std::optional<ResidualSpread> spread = SpreadOf(solution.residuals)) {
    registration.rms_px = spread->rms_px * to_photograph;
    registration.robust_sigma_px = spread->robust_sigma_px * to_photograph;
  }
  registration.residuals =
      MeanResiduals(solution.residuals, kResidualPieceWidths * prior.width_px, to_photograph);
  registration.moved_px =
      to_photograph *
      MeanDisplacementPx(points_in_world, prior.ProjectionAt(CameraParameters::Zero()), projection);
  FillSigmas(prior, projection, model, registration);
}

void AddToCovariance(const CameraCovariance& added,
                     const CameraPrior& prior,
                     const CameraParameters& whitened,
                     const PolygonModel& model,
                     Registration& registration) {
  registration.covariance += added;
  FillSigmas(prior, prior.ProjectionAt(whitened), model, registration);
}

void RecordEvidence(const Evidence& evidence, Registration& registration) {
  registration.score_nats = evidence.score.nats;
  registration.margin_nats = evidence.margin_nats;
  registration.rival = evidence.second_best;
}

}  // namespace groundglass
