// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/calibrate_lines.h"

#include "calibrate/building_axes.h"
#include "calibrate/line_segments.h"
#include "calibrate/lines_cost.h"
#include "scene/check_option.h"
#include "scene/cholesky.h"
#include "scene/frames.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace groundglass {
namespace {

struct LinesState {
  LensNumbers lens = LensNumbers::Zero();
  Eigen::Quaterniond cam_from_building = Eigen::Quaterniond::Identity();
};

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

class LinesSolver {
 public:
  LinesSolver(std::span<const LineSegment> segments,
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

  // Improves a camera; false if too few segments follow it.
  bool Solve(const LinesCamera& start) {
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

  // Of every segment, followed or not: what it costs to believe this camera.
  double Cost() const {
    constexpr double kMost = 9;
    double cost = 0;
    for (const SegmentCost& segment : costs_) {
      const double residual = Residual(segment).second;
      cost += std::min(residual * residual, kMost);
    }
    const LensPriorCost prior = MakePrior(options_);
    return cost + (state_.lens - prior.mean).cwiseQuotient(prior.sigmas).squaredNorm();
  }

  LinesResult Result() const;
  double Focal() const { return std::exp(state_.lens[0]); }

 private:
  static constexpr double kFarInSigmas = 60;
  static constexpr double kOutlierInSpreads = 3.5;
  static constexpr size_t kPartsOfDirection = 4;

  // The nearest direction's number, and the residual to it.
  std::pair<int, double> Residual(const SegmentCost& segment) const {
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

  void Assign(double most_sine, double most_sigmas) {
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

  // Every building shows verticals, and one level direction at least.
  bool IsEnough() const {
    return static_cast<int>(followed_.size()) >= options_.min_segments &&
           num_of_axis_[2] >= options_.min_segments_of_direction &&
           std::max(num_of_axis_[0], num_of_axis_[1]) >= options_.min_segments_of_direction;
  }

  // The residuals' spread, from their median.
  void MeasureSpread() {
    std::vector<double> sizes;
    for (const size_t i : followed_) sizes.push_back(std::abs(Residual(costs_[i]).second));
    if (sizes.empty()) return;
    std::nth_element(
        sizes.begin(), sizes.begin() + static_cast<long>(sizes.size() / 2), sizes.end());
    spread_ = std::max(1.0, 1.4826 * sizes[sizes.size() / 2]);
  }

  void AddResiduals(ceres::Problem& problem, LinesState& state, bool is_robust) const {
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
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LensPriorCost, kNumLens, kNumLens>(
                                 new LensPriorCost(prior)),
                             nullptr,
                             state.lens.data());
    problem.SetManifold(state.cam_from_building.coeffs().data(),
                        new ceres::EigenQuaternionManifold);
  }

  void Minimise(bool is_robust) {
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

  // Of lens and directions (the last three: a turn as Ceres adds it), scaled by the spread.
  using Covariance = Eigen::Matrix<double, kNumLens + 3, kNumLens + 3>;
  std::optional<Covariance> FindCovariance() const;
  Covariance FindJackknife() const;

  LinesOptions options_;
  double width_px_;
  std::vector<SegmentCost> costs_;
  std::vector<double> half_lengths_px_;
  std::vector<size_t> followed_;
  std::array<int, 3> num_of_axis_ = {0, 0, 0};
  double spread_ = 1;
  LinesState state_;
};

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

// Roll and pitch (radians) of a camera in which the vertical has this direction (down).
Eigen::Vector2d RollAndPitch(const Eigen::Vector3d& down_in_cam) {
  return {std::atan2(down_in_cam.x(), down_in_cam.y()),
          -std::asin(std::clamp(down_in_cam.z(), -1.0, 1.0))};
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

}  // namespace

void LinesOptions::Check() const {
  CheckAbove(center_sigma, 0, "lines options: center_sigma");
  CheckAbove(k1_sigma, 0, "lines options: k1_sigma");
  CheckFromTo(shortest_share, 0.001, 0.5, "lines options: shortest_share");
  CheckFromTo(min_segments_of_direction, 2, 1e6, "lines options: min_segments_of_direction");
  CheckFromTo(min_segments, 4, 1e6, "lines options: min_segments");
  CheckAtLeast(inflation, 1, "lines options: inflation");
  CheckAbove(worst_view_angle_share, 0, "lines options: worst_view_angle_share");
  CheckAtLeast(rival_share, 0, "lines options: rival_share");
  if (aspect) CheckFromTo(*aspect, 0.1, 10, "aspect");
  CheckAtLeast(aspect_sigma, 0, "lines options: aspect_sigma");
  CheckAbove(worst_aspect_share, 0, "lines options: worst_aspect_share");
}

LinesResult CalibrateLines(const Image8& srgb_grey, const LinesOptions& options, uint64_t seed) {
  options.Check();
  LinesResult none;
  if (options.aspect && options.aspect_sigma > options.worst_aspect_share * *options.aspect) {
    none.reason = fmt::format(
        "the shape of its pixels is not known (width / height {:.2f} to {:.2f}); --aspect tells it",
        *options.aspect - options.aspect_sigma,
        *options.aspect + options.aspect_sigma);
    return none;
  }
  std::vector<LineSegment> segments =
      FindLineSegments(srgb_grey, options.shortest_share * srgb_grey.width);
  // As if the picture's pixels were square and as wide as they are.
  const double width = srgb_grey.width;
  const double stretch = options.aspect ? width / (*options.aspect * srgb_grey.height) : 1;
  const Eigen::Vector2d middle_px(width / 2, stretch * srgb_grey.height / 2);
  for (LineSegment& segment : segments) {
    segment.begin_px.y() *= stretch;
    segment.end_px.y() *= stretch;
  }
  const std::vector<LinesCamera> starts = FindBuildingAxes(segments, middle_px, width, seed);
  struct Found {
    LinesSolver solver;
    double cost = 0;
  };
  std::vector<Found> found;
  for (const LinesCamera& start : starts) {
    LinesSolver solver(segments, middle_px, options);
    if (!solver.Solve(start)) continue;
    const double cost = solver.Cost();
    found.push_back({std::move(solver), cost});
  }
  if (found.empty()) {
    none.reason = "too few lines (" + std::to_string(segments.size()) +
                  ") follow two directions at right angles";
    return none;
  }
  std::stable_sort(
      found.begin(), found.end(), [](const Found& a, const Found& b) { return a.cost < b.cost; });
  LinesResult result = found.front().solver.Result();
  if (!result.is_found) return result;
  if (!(result.sigma_view_angle_deg < options.worst_view_angle_share * result.view_angle_deg)) {
    none.reason =
        "the lines leave the view angle open, as those of one wall seen from the front do";
    return none;
  }
  for (const Found& other : found) {
    if (other.cost > found.front().cost * (1 + options.rival_share)) break;
    const double ratio = other.solver.Focal() / found.front().solver.Focal();
    if (std::abs(std::log(ratio)) > 4 * options.worst_view_angle_share) {
      none.reason = "two cameras suit the lines as well";
      return none;
    }
  }
  return result;
}

KnownKeys KeysOfLines(const LinesResult& result, const LinesOptions& options) {
  constexpr double kTellsShare = 0.7;  // of what was known before
  KnownKeys keys;
  if (!result.is_found) return keys;
  const std::string lines = std::to_string(result.num_segments) + " lines";
  AddKnown(keys, "v", result.view_angle_deg, lines);
  AddKnown(keys, "sigma_v", result.sigma_view_angle_deg);
  AddKnown(keys, "roll", result.roll_deg);
  AddKnown(keys, "sigma_roll", result.sigma_roll_deg);
  const double sigma_shift = std::max(result.sigma_shift_x, result.sigma_shift_y);
  if (sigma_shift < kTellsShare * options.center_sigma) {
    AddKnown(keys, "shift_x", result.shift_x);
    AddKnown(keys, "shift_y", result.shift_y);
    AddKnown(keys, "sigma_shift", sigma_shift);
  }
  if (result.sigma_k1 < kTellsShare * options.k1_sigma) {
    AddKnown(keys, "k1", result.k1);
    AddKnown(keys, "sigma_k1", result.sigma_k1);
  }
  return keys;
}

}  // namespace groundglass
