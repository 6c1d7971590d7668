// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "calibrate/building_axes.h"
#include "calibrate/calibrate_lines.h"
#include "calibrate/line_segments.h"
#include "calibrate/lines_cost.h"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace ceres {
class Problem;
}

namespace groundglass {

struct LinesState {
  LensNumbers lens = LensNumbers::Zero();
  Eigen::Quaterniond cam_from_building = Eigen::Quaterniond::Identity();
};

// The camera in which segments of a picture follow the building's three directions, found by least
// squares from a camera that is nearly that, and how well it is known.
class LinesSolver {
 public:
  LinesSolver(std::span<const LineSegment> segments,
              const Eigen::Vector2d& middle_px,
              const LinesOptions& options);

  // Improves a camera; false if too few segments follow it.
  bool Solve(const LinesCamera& start);

  // Of every segment, followed or not: what it costs to believe this camera.
  double Cost() const;

  LinesResult Result() const;
  double Focal() const { return std::exp(state_.lens[0]); }

 private:
  static constexpr double kFarInSigmas = 60;
  static constexpr double kOutlierInSpreads = 3.5;
  static constexpr size_t kPartsOfDirection = 4;

  // The nearest direction's number, and the residual to it.
  std::pair<int, double> Residual(const SegmentCost& segment) const;

  void Assign(double most_sine, double most_sigmas);

  // Every building shows verticals, and one level direction at least.
  bool IsEnough() const;

  // The residuals' spread, from their median.
  void MeasureSpread();

  void AddResiduals(ceres::Problem& problem, LinesState& state, bool is_robust) const;

  void Minimise(bool is_robust);

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

}  // namespace groundglass
