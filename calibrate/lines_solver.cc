// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/lines_solver.h"

#include "scene/cholesky.h"
#include "scene/frames.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

LensPriorCost MakePrior(const LinesOptions& options) {
  LensPriorCost prior;
  prior.mean << 0, 0, 0, 0;  // a view angle of 53 degrees
  prior.sigmas << 0.7, options.center_sigma, options.center_sigma, options.k1_sigma;
  return prior;
}

// What a segment's ends may err by, one standard deviation; pixels: noise, which a long edge
// averages, what straight edges of buildings are off by, and directions that are not quite
// parallel.
double EndSigma_px(double length_px) {
  return std::sqrt(3 * 0.35 * 0.35 / length_px + 0.08 * 0.08 +
                   0.0005 * length_px * 0.0005 * length_px);
}

// Roll and pitch (radians) of a camera in which the vertical has this direction (down).
Eigen::Vector2d RollAndPitch(const Eigen::Vector3d& down_in_cam) {
  return {std::atan2(down_in_cam.x(), down_in_cam.y()),
          -std::asin(std::clamp(down_in_cam.z(), -1.0, 1.0))};
}

}  // namespace

LinesSolver::LinesSolver(std::span<const LineSegment> segments,
                         const Eigen::Vector2d& middle_px,
                         const LinesOptions& options)
    : options_(options), width_px_(2 * middle_px.x()) {
  for (const LineSegment& segment : segments) {
    SegmentCost cost;
    cost.place = (segment.Middle() - middle_px) / width_px_;
    cost.direction = segment.Direction();
    cost.half_length_in_sigmas = segment.Length() / 2 / EndSigma_px(segment.Length());
    costs_.push_back(cost);
    half_lengths_px_.push_back(segment.Length() / 2);
  }
}

bool LinesSolver::Solve(const LinesCamera& start) {
  state_.lens << std::log(start.focal), start.center.x(), start.center.y(), start.k1;
  state_.cam_from_building = Eigen::Quaterniond(start.axes_in_cam);
  for (const double limit_deg : {2.5, 1.5, 1.0}) {
    Assign(std::sin(RadiansFromDegrees(limit_deg)), kFarInSigmas);
    if (!IsEnough()) return false;
    Minimise(true);
  }
  for (int round = 0; round < 3; ++round) {
    MeasureSpread();
    Assign(std::sin(RadiansFromDegrees(1.5)), kOutlierInSpreads * spread_);
    if (!IsEnough()) return false;
    Minimise(false);
  }
  MeasureSpread();
  return true;
}

double LinesSolver::Cost() const {
  constexpr double kMost = 9;
  double cost = 0;
  for (const SegmentCost& segment : costs_) {
    const double residual = Residual(segment).second;
    cost += std::min(residual * residual, kMost);
  }
  const LensPriorCost prior = MakePrior(options_);
  return cost + (state_.lens - prior.mean).cwiseQuotient(prior.sigmas).squaredNorm();
}

std::pair<int, double> LinesSolver::Residual(const SegmentCost& segment) const {
  std::pair<int, double> best = {0, HUGE_VAL};
  for (int axis = 0; axis < 3; ++axis) {
    SegmentCost cost = segment;
    cost.axis = axis;
    double residual = 0;
    cost(state_.lens.data(), state_.cam_from_building.coeffs().data(), &residual);
    if (std::abs(residual) < std::abs(best.second)) best = {axis, residual};
  }
  return best;
}

void LinesSolver::Assign(double most_sine, double most_sigmas) {
  followed_.clear();
  num_of_axis_ = {0, 0, 0};
  for (size_t i = 0; i < costs_.size(); ++i) {
    const auto [axis, residual] = Residual(costs_[i]);
    if (std::abs(residual) > most_sigmas ||
        std::abs(residual) > most_sine * costs_[i].half_length_in_sigmas) {
      continue;
    }
    costs_[i].axis = axis;
    followed_.push_back(i);
    ++num_of_axis_[static_cast<size_t>(axis)];
  }
  // A few lines meet by accident.
  std::erase_if(followed_, [&](size_t i) {
    return num_of_axis_[static_cast<size_t>(costs_[i].axis)] < options_.min_segments_of_direction;
  });
}

bool LinesSolver::IsEnough() const {
  return static_cast<int>(followed_.size()) >= options_.min_segments &&
         num_of_axis_[2] >= options_.min_segments_of_direction &&
         std::max(num_of_axis_[0], num_of_axis_[1]) >= options_.min_segments_of_direction;
}

void LinesSolver::MeasureSpread() {
  std::vector<double> sizes;
  for (const size_t i : followed_) sizes.push_back(std::abs(Residual(costs_[i]).second));
  if (sizes.empty()) return;
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<long>(sizes.size() / 2), sizes.end());
  spread_ = std::max(1.0, 1.4826 * sizes[sizes.size() / 2]);
}

void LinesSolver::AddResiduals(ceres::Problem& problem, LinesState& state, bool is_robust) const {
  for (const size_t i : followed_) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<SegmentCost, 1, kNumLens, 4>(new SegmentCost(costs_[i])),
        is_robust ? new ceres::CauchyLoss(3.0) : nullptr,
        state.lens.data(),
        state.cam_from_building.coeffs().data());
  }
  // Against residuals of this spread.
  LensPriorCost prior = MakePrior(options_);
  prior.sigmas /= spread_ * options_.inflation;
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<LensPriorCost, kNumLens, kNumLens>(new LensPriorCost(prior)),
      nullptr,
      state.lens.data());
  problem.SetManifold(state.cam_from_building.coeffs().data(), new ceres::EigenQuaternionManifold);
}

void LinesSolver::Minimise(bool is_robust) {
  ceres::Problem problem;
  AddResiduals(problem, state_, is_robust);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 50;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
}

std::optional<LinesSolver::Covariance> LinesSolver::FindCovariance() const {
  LinesState state = state_;
  ceres::Problem problem;
  AddResiduals(problem, state, false);
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = {state.lens.data(), state.cam_from_building.coeffs().data()};
  ceres::CRSMatrix jacobian;
  if (!problem.Evaluate(options, nullptr, nullptr, nullptr, &jacobian)) return std::nullopt;
  Covariance information = Covariance::Zero();
  for (int row = 0; row < jacobian.num_rows; ++row) {
    Eigen::Matrix<double, kNumLens + 3, 1> by_numbers =
        Eigen::Matrix<double, kNumLens + 3, 1>::Zero();
    for (int at = jacobian.rows[row]; at < jacobian.rows[row + 1]; ++at) {
      by_numbers[jacobian.cols[at]] = jacobian.values[at];
    }
    information += by_numbers * by_numbers.transpose();
  }
  const std::optional<Eigen::MatrixXd> all = InvertByCholesky(information);
  if (!all) return std::nullopt;
  const double scale = spread_ * options_.inflation;
  return *all * scale * scale;
}

// Lines that lie together err together: what the camera would be without each part of those that
// follow one direction, side by side (the grouped jackknife: Efron & Tibshirani 1993,
// section 11.5).
LinesSolver::Covariance LinesSolver::FindJackknife() const {
  std::vector<std::vector<size_t>> parts;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<size_t> own;
    for (const size_t i : followed_) {
      if (costs_[i].axis == axis) own.push_back(i);
    }
    // Across their direction.
    const int side = axis == 2 ? 0 : 1;
    std::stable_sort(own.begin(), own.end(), [&](size_t a, size_t b) {
      return costs_[a].place[side] < costs_[b].place[side];
    });
    const size_t num_parts = std::min<size_t>(kPartsOfDirection, own.size());
    for (size_t part = 0; part < num_parts; ++part) {
      parts.emplace_back(own.begin() + static_cast<long>(part * own.size() / num_parts),
                         own.begin() + static_cast<long>((part + 1) * own.size() / num_parts));
    }
  }
  Covariance sum = Covariance::Zero();
  for (const std::vector<size_t>& part : parts) {
    LinesSolver without = *this;
    std::erase_if(without.followed_,
                  [&](size_t i) { return std::find(part.begin(), part.end(), i) != part.end(); });
    without.Minimise(false);
    Eigen::Matrix<double, kNumLens + 3, 1> change;
    Eigen::Vector3d turn;
    ceres::EigenQuaternionManifold().Minus(without.state_.cam_from_building.coeffs().data(),
                                           state_.cam_from_building.coeffs().data(),
                                           turn.data());
    change << without.state_.lens - state_.lens, turn;
    sum += change * change.transpose();
  }
  const double num_parts = static_cast<double>(parts.size());
  return sum * (num_parts - 1) / num_parts;
}

LinesResult LinesSolver::Result() const {
  LinesResult result;
  std::optional<Covariance> covariance = FindCovariance();
  if (!covariance) {
    result.reason = "the lines leave the camera undetermined";
    return result;
  }
  *covariance += FindJackknife();
  const auto sigma = [&](int i) { return std::sqrt((*covariance)(i, i)); };
  const double focal = Focal();
  result.is_found = true;
  result.view_angle_deg = DegreesFromRadians(2 * std::atan(0.5 / focal));
  result.sigma_view_angle_deg = DegreesFromRadians(focal / (focal * focal + 0.25)) * sigma(0);
  result.shift_x = state_.lens[1];
  result.sigma_shift_x = sigma(1);
  result.shift_y = state_.lens[2];
  result.sigma_shift_y = sigma(2);
  result.k1 = state_.lens[3];
  result.sigma_k1 = sigma(3);
  // Roll and pitch by finite differences over the turn, as Ceres adds it: (half angles, before).
  const auto roll_and_pitch = [&](const Eigen::Vector3d& delta) {
    Eigen::Quaterniond turned;
    const Eigen::Vector4d before = state_.cam_from_building.coeffs();
    ceres::EigenQuaternionManifold().Plus(before.data(), delta.data(), turned.coeffs().data());
    return RollAndPitch(turned * Eigen::Vector3d::UnitZ());
  };
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, 2, 3> by_turn;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
    by_turn.col(i) = (roll_and_pitch(step) - roll_and_pitch(-step)) / (2 * kStep);
  }
  const Eigen::Matrix2d of_angles =
      by_turn * covariance->bottomRightCorner<3, 3>() * by_turn.transpose();
  const Eigen::Vector2d angles = roll_and_pitch(Eigen::Vector3d::Zero());
  result.roll_deg = DegreesFromRadians(angles[0]);
  result.sigma_roll_deg = DegreesFromRadians(std::sqrt(of_angles(0, 0)));
  result.pitch_deg = DegreesFromRadians(angles[1]);
  result.sigma_pitch_deg = DegreesFromRadians(std::sqrt(of_angles(1, 1)));
  result.num_segments = static_cast<int>(followed_.size());
  result.num_of_direction = num_of_axis_;
  double sum = 0;
  for (const size_t i : followed_) {
    const double off_px =
        Residual(costs_[i]).second * half_lengths_px_[i] / costs_[i].half_length_in_sigmas;
    sum += off_px * off_px;
  }
  result.rms_px = std::sqrt(sum / static_cast<double>(followed_.size()));
  return result;
}

}  // namespace groundglass
