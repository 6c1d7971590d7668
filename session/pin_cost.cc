// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/pin_cost.h"

#include <algorithm>
#include <iterator>

namespace groundglass {
namespace {

template <typename Pin>
std::vector<Pin> UsedOf(const std::vector<Pin>& pins) {
  std::vector<Pin> used;
  std::copy_if(pins.begin(), pins.end(), std::back_inserter(used), [](const Pin& pin) {
    return pin.use == PinUse::kUsed;
  });
  return used;
}

}  // namespace

std::optional<LineDistances> MeasureLine(const LinePin& pin,
                                         const ParameterProjection& projection) {
  const auto start = projection.Project(pin.start_in_world);
  const auto end = projection.Project(pin.end_in_world);
  if (!start || !end) return std::nullopt;
  const Eigen::Vector2d along = end->image_px - start->image_px;
  const double length = along.norm();
  if (!(length > 1e-9)) return std::nullopt;
  LineDistances measured;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d to_image = (i == 0 ? pin.first_px : pin.second_px) - start->image_px;
    const double distance = (along.x() * to_image.y() - along.y() * to_image.x()) / length;
    // distance = cross(end - start, image - start) / |end - start|
    const Eigen::RowVector2d turn = distance / (length * length) * along.transpose();
    const Eigen::RowVector2d by_end =
        Eigen::RowVector2d(to_image.y(), -to_image.x()) / length - turn;
    const Eigen::RowVector2d by_start =
        Eigen::RowVector2d(along.y() - to_image.y(), to_image.x() - along.x()) / length + turn;
    measured.distances_px[i] = distance;
    measured.jacobian.row(i) = by_start * start->jacobian + by_end * end->jacobian;
  }
  return measured;
}

PinCost::PinCost(const Pins& pins, const CameraPrior& prior)
    : points_(UsedOf(pins.points)), lines_(UsedOf(pins.lines)), prior_(prior) {
  set_num_residuals(2 * static_cast<int>(points_.size() + lines_.size()));
  mutable_parameter_block_sizes()->push_back(kNumCameraParameters);
}

bool PinCost::Evaluate(double const* const* parameters,
                       double* residuals,
                       double** jacobians) const {
  using Rows = Eigen::Matrix<double, 2, kNumCameraParameters, Eigen::RowMajor>;
  const Eigen::Map<const CameraParameters> whitened(parameters[0]);
  const ParameterProjection projection = prior_.ProjectionAt(whitened);
  int row = 0;
  const auto write = [&](const Eigen::Vector2d& residual,
                         const Eigen::Matrix<double, 2, kNumCameraParameters>& jacobian,
                         double sigma_px) {
    Eigen::Map<Eigen::Vector2d>(residuals + row) = residual / sigma_px;
    if (jacobians && jacobians[0]) {
      Eigen::Map<Rows>(jacobians[0] + row * kNumCameraParameters) =
          jacobian * prior_.root / sigma_px;
    }
    row += 2;
  };
  for (const PointPin& pin : points_) {
    const auto projected = projection.Project(pin.point_in_world);
    if (!projected) return false;
    write(projected->image_px - pin.image_px, projected->jacobian, pin.sigma_px);
  }
  for (const LinePin& pin : lines_) {
    const auto measured = MeasureLine(pin, projection);
    if (!measured) return false;
    write(measured->distances_px, measured->jacobian, pin.sigma_px);
  }
  return true;
}

}  // namespace groundglass
