// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/joint/shared_edge_cost.h"

#include "register/camera/parameter_projection.h"
#include "register/edges/edge_whitening.h"

#include <cmath>

namespace groundglass {
namespace {

constexpr size_t kFirstGroup = 3;  // among the parameter blocks

}  // namespace

SharedEdgeCost::SharedEdgeCost(std::vector<AlignedSample> samples,
                               const SplitPrior& prior,
                               const EdgeFrame& frame,
                               std::vector<EdgeGroupPart> groups)
    : samples_(std::move(samples)), prior_(prior), frame_(frame), groups_(std::move(groups)) {
  set_num_residuals(static_cast<int>(samples_.size()));
  *mutable_parameter_block_sizes() = {kNumCameraParameters, kNumLensParameters, 4};
  for (const EdgeGroupPart& part : groups_) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(part.directions.cols()));
  }
}

bool SharedEdgeCost::Evaluate(double const* const* parameters,
                              double* residuals,
                              double** jacobians) const {
  using ByCamera = Eigen::Matrix<double, Eigen::Dynamic, kNumCameraParameters, Eigen::RowMajor>;
  using ByLens = Eigen::Matrix<double, Eigen::Dynamic, kNumLensParameters, Eigen::RowMajor>;
  using ByGroup = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using ByEdge = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
  const Eigen::Map<const CameraParameters> whitened(parameters[0]);
  const Eigen::Map<const Eigen::Vector4d> displacement(parameters[2]);
  const Eigen::Map<const LensParameters> lens(parameters[1]);
  const ParameterProjection projection = prior_.ProjectionAt(whitened, lens);

  Eigen::Vector3d group_move = Eigen::Vector3d::Zero();
  for (size_t g = 0; g < groups_.size(); ++g) {
    const auto& directions = groups_[g].directions;
    for (Eigen::Index k = 0; k < directions.cols(); ++k) {
      group_move += parameters[kFirstGroup + g][k] * directions.col(k);
    }
  }
  const auto count = static_cast<Eigen::Index>(samples_.size());
  Eigen::Map<Eigen::VectorXd> r(residuals, count);
  ByCamera by_camera(count, kNumCameraParameters);
  ByEdge by_edge(count, 4);
  std::vector<ByGroup> by_group;
  for (const EdgeGroupPart& part : groups_) by_group.emplace_back(count, part.directions.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    const AlignedSample& sample = samples_[i];
    const auto projected = projection.Project(sample.point_in_world + group_move +
                                              frame_.Displacement(displacement, sample.along));
    if (!projected) return false;
    const double weight = std::sqrt(sample.precision);
    r[i] = weight * (sample.normal.dot(projected->image_px - sample.origin_px) - sample.offset_px);
    by_camera.row(i) = weight * sample.normal.transpose() * projected->jacobian;
    // Moving the point is moving the camera the other way.
    const Eigen::RowVector3d by_point = -by_camera.row(i).head<3>();
    by_edge.row(i).head<2>() = by_point * frame_.across;
    for (size_t g = 0; g < groups_.size(); ++g) {
      by_group[g].row(i) = by_point * groups_[g].directions;
    }
    by_edge.row(i).tail<2>() = sample.along * frame_.turn_ratio * by_edge.row(i).head<2>();
  }
  const EdgeWhitening whitening(samples_);
  whitening.Apply(r);
  if (!jacobians) return true;
  if (jacobians[0] || jacobians[1]) whitening.Apply(by_camera);
  if (jacobians[0]) {
    Eigen::Map<ByCamera>(jacobians[0], count, kNumCameraParameters) = by_camera * prior_.own_root;
  }
  if (jacobians[1]) {
    Eigen::Map<ByLens>(jacobians[1], count, kNumLensParameters) = by_camera * prior_.lens_root;
  }
  if (jacobians[2]) {
    whitening.Apply(by_edge);
    Eigen::Map<ByEdge>(jacobians[2], count, 4) = by_edge;
  }
  for (size_t g = 0; g < groups_.size(); ++g) {
    double* jacobian = jacobians[kFirstGroup + g];
    if (!jacobian) continue;
    whitening.Apply(by_group[g]);
    Eigen::Map<ByGroup>(jacobian, count, by_group[g].cols()) = by_group[g];
  }
  return true;
}

}  // namespace groundglass
