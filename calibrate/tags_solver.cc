// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/tags_solver.h"

#include "scene/cholesky.h"
#include "scene/frames.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// (x - mean) / sigma, number by number.
template <int N>
struct NormalPriorCost {
  Eigen::Matrix<double, N, 1> mean, sigmas;
  template <typename T>
  bool operator()(const T* x, T* residuals) const {
    for (int i = 0; i < N; ++i) residuals[i] = (x[i] - mean[i]) / sigmas[i];
    return true;
  }
};

}  // namespace

TagsState TagsSolver::Start(const RigidTransform& cam_from_world) const {
  TagsState state;
  state.cam_from_world = Eigen::Quaterniond(cam_from_world.rotation);
  state.world_origin_in_cam = cam_from_world.translation;
  state.lens << RadiansFromDegrees(lens_.view_angle_deg), lens_.shift_x, lens_.shift_y, lens_.k1,
      lens_.aspect;
  state.offsets.assign(seen_.size(), Eigen::Vector3d::Zero());
  return state;
}

double TagsSolver::Minimise(TagsState& state) const {
  ceres::Problem problem;
  AddResiduals(problem, state);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 100;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable() ? summary.final_cost : HUGE_VAL;
}

Camera TagsSolver::CameraOf(const TagsState& state) const {
  ViewTag tag = lens_;
  tag.view_angle_deg = DegreesFromRadians(state.lens[0]);
  tag.shift_x = state.lens[1];
  tag.shift_y = state.lens[2];
  tag.k1 = state.lens[3];
  tag.aspect = state.lens[4];
  Camera camera = CameraFromTag(tag, size_.width, size_.height);
  camera.cam_from_world = state.Pose();
  return camera;
}

double TagsSolver::RmsPx(const TagsState& state) const {
  const Camera camera = CameraOf(state);
  double sum = 0;
  for (const SeenTag& seen : seen_) {
    for (int corner = 0; corner < 4; ++corner) {
      const auto expected = Project(camera, seen.place.corners_in_world.col(corner));
      if (!expected) return HUGE_VAL;
      sum += (*expected - seen.corners_px.segment<2>(2 * corner)).squaredNorm();
    }
  }
  return std::sqrt(sum / (8.0 * static_cast<double>(seen_.size())));
}

void TagsSolver::AddResiduals(ceres::Problem& problem, TagsState& state) const {
  double* const rotation = state.cam_from_world.coeffs().data();
  for (size_t i = 0; i < seen_.size(); ++i) {
    SeenTagCost cost{
        seen_[i], lens_, static_cast<double>(size_.width), static_cast<double>(size_.height)};
    cost.seen.root_information /= options_.edge_noise_px;
    double* const offset = state.offsets[i].data();
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<SeenTagCost, 8, 4, 3, kNumTagLens, 3>(
                                 new SeenTagCost(cost)),
                             nullptr,
                             rotation,
                             state.world_origin_in_cam.data(),
                             state.lens.data(),
                             offset);
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<NormalPriorCost<3>, 3, 3>(new NormalPriorCost<3>{
            Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(seen_[i].place.sigma)}),
        nullptr,
        offset);
  }
  const TagSigmas& noted = lens_.sigmas;
  const double shift = noted.shift.value_or(options_.shift);
  NormalPriorCost<kNumTagLens> prior;
  prior.mean << RadiansFromDegrees(lens_.view_angle_deg), lens_.shift_x, lens_.shift_y, lens_.k1,
      lens_.aspect;
  prior.sigmas << RadiansFromDegrees(
      noted.view_angle_deg.value_or(options_.view_angle_share * lens_.view_angle_deg)),
      shift, shift, noted.k1.value_or(options_.k1),
      noted.aspect.value_or(options_.aspect_share * lens_.aspect);
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<NormalPriorCost<kNumTagLens>, kNumTagLens, kNumTagLens>(
          new NormalPriorCost<kNumTagLens>(prior)),
      nullptr,
      state.lens.data());
  problem.SetManifold(rotation, new ceres::EigenQuaternionManifold);
}

std::optional<TagsSolver::Covariance> TagsSolver::FindCovariance(const TagsState& found) const {
  TagsState state = found;
  ceres::Problem problem;
  AddResiduals(problem, state);
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = {
      state.cam_from_world.coeffs().data(), state.world_origin_in_cam.data(), state.lens.data()};
  for (Eigen::Vector3d& offset : state.offsets) options.parameter_blocks.push_back(offset.data());
  ceres::CRSMatrix jacobian;
  if (!problem.Evaluate(options, nullptr, nullptr, nullptr, &jacobian)) return std::nullopt;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(jacobian.num_rows, jacobian.num_cols);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    for (int at = jacobian.rows[row]; at < jacobian.rows[row + 1]; ++at) {
      dense(row, jacobian.cols[at]) = jacobian.values[at];
    }
  }
  const std::optional<Eigen::MatrixXd> all = InvertByCholesky(dense.transpose() * dense);
  if (!all) return std::nullopt;
  return Covariance(all->topLeftCorner<kNumFree, kNumFree>());
}

Eigen::Matrix<double, 8, 1> TagsSolver::Numbers(const TagsState& state, double distance) const {
  const Camera camera = CameraOf(state);
  const ViewTag tag = TagFromCamera(camera, distance);
  Eigen::Matrix<double, 8, 1> numbers;
  numbers << tag.position_in_site, tag.lookat_in_site, tag.roll_deg, tag.view_angle_deg;
  return numbers;
}

std::optional<ViewTag> TagsSolver::TagOf(const TagsState& state, double cost) const {
  const std::optional<Covariance> covariance = FindCovariance(state);
  if (!covariance) return std::nullopt;
  const Camera camera = CameraOf(state);
  double distance = 0;
  for (const SeenTag& seen : seen_) {
    distance += (camera.cam_from_world * seen.place.corners_in_world.rowwise().mean()).z();
  }
  distance /= static_cast<double>(seen_.size());
  Eigen::Matrix<double, 8, kNumFree> by_free;
  for (int i = 0; i < kNumFree; ++i) {
    const double step = i < 3 || i >= 6 ? 1e-6 : 1e-6 * distance;
    const auto stepped = [&](double by) {
      TagsState other = state;
      if (i < 3) {
        const Eigen::Vector3d turn = by * Eigen::Vector3d::Unit(i);
        ceres::EigenQuaternionManifold().Plus(state.cam_from_world.coeffs().data(),
                                              turn.data(),
                                              other.cam_from_world.coeffs().data());
      } else if (i < 6) {
        other.world_origin_in_cam[i - 3] += by;
      } else {
        other.lens[i - 6] += by;
      }
      return Numbers(other, distance);
    };
    by_free.col(i) = (stepped(step) - stepped(-step)) / (2 * step);
  }
  // Corners that fit worse than they should widen everything.
  const double degrees_of_freedom = std::max(1.0, 8.0 * static_cast<double>(seen_.size()) - 6);
  const double spread = std::max(1.0, std::sqrt(2 * cost / degrees_of_freedom));
  const Eigen::Matrix<double, 8, 1> sigmas =
      spread * (by_free * *covariance * by_free.transpose()).diagonal().cwiseSqrt();
  ViewTag tag = TagFromCamera(camera, distance);
  tag.camera = lens_.camera;
  tag.sigmas = lens_.sigmas;
  tag.sigmas.position = std::max(sigmas[0], sigmas[1]);
  tag.sigmas.height = sigmas[2];
  tag.sigmas.lookat = sigmas.segment<3>(3).maxCoeff();
  tag.sigmas.roll_deg = sigmas[6];
  tag.sigmas.view_angle_deg = sigmas[7];
  return tag;
}

}  // namespace groundglass
