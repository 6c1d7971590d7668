// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/pin_solver.h"

#include "register/register.h"
#include "scene/check_option.h"
#include "scene/least_norm.h"
#include "session/pin_cost.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// |u|^2 / 2: the prior, in whitened parameters.
class WhitenedPrior : public ceres::SizedCostFunction<kNumCameraParameters, kNumCameraParameters> {
 public:
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    Eigen::Map<CameraParameters>(residuals, kNumCameraParameters) =
        Eigen::Map<const CameraParameters>(parameters[0]);
    if (jacobians && jacobians[0]) {
      Eigen::Map<CameraCovariance>(jacobians[0], kNumCameraParameters, kNumCameraParameters)
          .setIdentity();
    }
    return true;
  }
};

int CountUsed(const Pins& pins) {
  const auto is_used = [](const auto& pin) { return pin.use == PinUse::kUsed; };
  return static_cast<int>(std::count_if(pins.points.begin(), pins.points.end(), is_used) +
                          std::count_if(pins.lines.begin(), pins.lines.end(), is_used));
}

// The prior of one or two pins: what they cannot tell stays as it is.
void HoldBack(int num_pins, const PinSolverOptions& options, CameraPrior& prior) {
  const CameraParameters sigmas = prior.sigmas;
  CameraCovariance root = CameraCovariance::Zero();
  // Aiming is free within a half turn: it is what the pin is there for.
  root(kYaw, kYaw) = std::max(sigmas[kYaw], options.aim_yaw_deg);
  root(kPitch, kPitch) = std::max(sigmas[kPitch], options.aim_pitch_deg);
  if (num_pins > 1) {
    root(kRoll, kRoll) = std::max(sigmas[kRoll], options.aim_roll_deg);
    const double yaw = RadiansFromDegrees(prior.mean[kYaw]);
    const double pitch = RadiansFromDegrees(prior.mean[kPitch]);
    const Eigen::Vector3d along(
        std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch));
    root.block<3, 1>(kPositionX, kPositionX) = along * sigmas.head<3>().maxCoeff();
  }
  prior.root = root;
}

struct Minimum {
  bool is_usable = false;
  double cost = 0;
  CameraParameters whitened = CameraParameters::Zero();
};

Minimum Minimise(const Pins& pins,
                 const CameraPrior& prior,
                 const CameraParameters& start,
                 const PinSolverOptions& solver_options) {
  Minimum minimum;
  minimum.whitened = start;
  ceres::Problem::Options problem_options;
  problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  PinCost pin_cost(pins, prior);
  WhitenedPrior whitened_prior;
  // A start that sees a pin behind it is none; the solver would complain aloud.
  Eigen::VectorXd residuals(pin_cost.num_residuals());
  const double* blocks[] = {start.data()};
  if (!pin_cost.Evaluate(blocks, residuals.data(), nullptr)) return minimum;
  problem.AddResidualBlock(&pin_cost, nullptr, minimum.whitened.data());
  problem.AddResidualBlock(&whitened_prior, nullptr, minimum.whitened.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = solver_options.max_iterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  minimum.is_usable = summary.IsSolutionUsable() && minimum.whitened.allFinite();
  minimum.cost = summary.final_cost;
  return minimum;
}

// Cameras to begin with: the last one, the tag's, and the tag's turned towards the pins.
std::vector<CameraParameters> Starts(const CameraPrior& prior,
                                     const std::optional<ViewTag>& start,
                                     const Pins& pins) {
  std::vector<CameraParameters> starts;
  if (start) starts.push_back(ParametersFromTag(*start));
  starts.push_back(prior.mean);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  int count = 0;
  for (const PointPin& pin : pins.points) {
    middle += pin.point_in_world;
    ++count;
  }
  for (const LinePin& pin : pins.lines) {
    middle += (pin.start_in_world + pin.end_in_world) / 2;
    ++count;
  }
  CameraParameters turned = prior.mean;
  const Eigen::Vector3d to_middle = middle / std::max(count, 1) - turned.head<3>();
  turned[kYaw] = DegreesFromRadians(std::atan2(to_middle.y(), to_middle.x()));
  turned[kPitch] = DegreesFromRadians(std::atan2(to_middle.z(), to_middle.head<2>().norm()));
  // The same turn as the prior's mean, not one that is a whole turn away.
  turned[kYaw] += 360 * std::round((prior.mean[kYaw] - turned[kYaw]) / 360);
  starts.push_back(turned);
  return starts;
}

// Whitened parameters of a camera; those that are held do not count.
CameraParameters WhitenedOf(const CameraPrior& prior, const CameraParameters& parameters) {
  CameraParameters change = parameters - prior.mean;
  change[kYaw] -= 360 * std::round(change[kYaw] / 360);
  return SolveLeastNorm(prior.root, change);
}

// Baarda's test: a residual against its own deviation, which is less than the pin's by what the
// pin contributed to the camera; of a pin without a say more, by what the camera lacks.
double InSigmas(const Eigen::Vector2d& residual_px,
                const Eigen::Matrix<double, 2, kNumCameraParameters>& jacobian,
                const CameraCovariance& covariance,
                double sigma_px,
                bool is_used,
                double least_variance_share) {
  const Eigen::Matrix2d of_camera = jacobian * covariance * jacobian.transpose();
  const Eigen::Matrix2d of_pin = Eigen::Matrix2d::Identity() * sigma_px * sigma_px;
  Eigen::Matrix2d expected = is_used ? Eigen::Matrix2d(of_pin - of_camera) : of_pin + of_camera;
  expected += least_variance_share * of_pin;
  return std::sqrt(std::max(0.0, residual_px.dot(expected.inverse() * residual_px) / 2));
}

void FillResiduals(const Pins& pins,
                   const ParameterProjection& projection,
                   const PinSolverOptions& options,
                   PinSolution& solution) {
  double squares = 0;
  int count = 0;
  const auto judge = [&](PinResidual& residual, const auto& jacobian, const auto& pin) {
    residual.sigmas = InSigmas(residual.residual_px,
                               jacobian,
                               solution.covariance,
                               pin.sigma_px,
                               pin.use == PinUse::kUsed,
                               options.least_variance_share);
    residual.is_bad = pin.use != PinUse::kOff && residual.sigmas > options.bad_pin_sigmas;
    if (pin.use != PinUse::kUsed) return;
    squares += residual.size_px * residual.size_px;
    ++count;
  };
  for (const PointPin& pin : pins.points) {
    PinResidual& residual = solution.points.emplace_back();
    const auto seen = projection.Project(pin.point_in_world);
    if (!seen) continue;
    residual.seen_px = seen->image_px;
    residual.residual_px = seen->image_px - pin.image_px;
    residual.size_px = residual.residual_px.norm();
    judge(residual, seen->jacobian, pin);
  }
  for (const LinePin& pin : pins.lines) {
    PinResidual& residual = solution.lines.emplace_back();
    const auto measured = MeasureLine(pin, projection);
    if (!measured) continue;
    residual.residual_px = measured->distances_px;
    residual.size_px = residual.residual_px.cwiseAbs().maxCoeff();
    judge(residual, measured->jacobian, pin);
  }
  if (count > 0) solution.rms_px = std::sqrt(squares / count);
}

void NameWorst(PinSolution& solution) {
  double worst_sigmas = 0;
  const auto look_at = [&](const std::vector<PinResidual>& residuals, size_t first) {
    for (size_t i = 0; i < residuals.size(); ++i) {
      if (!residuals[i].is_bad || residuals[i].sigmas <= worst_sigmas) continue;
      worst_sigmas = residuals[i].sigmas;
      solution.worst = static_cast<int>(first + i);
    }
  };
  look_at(solution.points, 0);
  look_at(solution.lines, solution.points.size());
}

// The covariance to first order, in the camera's own parameters.
CameraCovariance PosteriorCovariance(const Pins& pins,
                                     const CameraPrior& prior,
                                     const CameraParameters& whitened) {
  PinCost cost(pins, prior);
  Eigen::VectorXd residuals(cost.num_residuals());
  Eigen::Matrix<double, Eigen::Dynamic, kNumCameraParameters, Eigen::RowMajor> jacobian(
      cost.num_residuals(), kNumCameraParameters);
  const double* blocks[] = {whitened.data()};
  double* jacobians[] = {jacobian.data()};
  CameraCovariance information = CameraCovariance::Identity();
  if (cost.num_residuals() > 0 && cost.Evaluate(blocks, residuals.data(), jacobians)) {
    information += jacobian.transpose() * jacobian;
  }
  return prior.root * SolveLeastNorm(information, prior.root.transpose());
}

}  // namespace

void PinSolverOptions::Check() const {
  CheckFromTo(max_iterations, 1, 10000, "pin solver options: max_iterations");
  CheckAbove(bad_pin_sigmas, 0, "pin solver options: bad_pin_sigmas");
  CheckFromTo(free_share, 0, 1, "pin solver options: free_share");
  CheckAbove(aim_yaw_deg, 0, "pin solver options: aim_yaw_deg");
  CheckAbove(aim_pitch_deg, 0, "pin solver options: aim_pitch_deg");
  CheckAbove(aim_roll_deg, 0, "pin solver options: aim_roll_deg");
  CheckFromTo(least_variance_share, 1e-6, 1, "pin solver options: least_variance_share");
  prior.Check();
}

PinSolution SolvePins(const ViewTag& tag,
                      const std::optional<ViewTag>& start,
                      int width_px,
                      int height_px,
                      LengthUnit unit,
                      const std::optional<Lens>& lens,
                      const Pins& pins,
                      const PinSolverOptions& options) {
  options.Check();
  PinSolution solution;
  solution.tag = tag;
  CameraPrior prior = MakeCameraPrior(tag, width_px, height_px, unit, lens, options.prior);
  solution.prior_sigmas = prior.sigmas;
  const CameraCovariance all_known = prior.root * prior.root.transpose();
  const int num_used = CountUsed(pins);
  if (num_used == 1 || num_used == 2) HoldBack(num_used, options, prior);
  Minimum best;
  for (const CameraParameters& from : Starts(prior, start, pins)) {
    const Minimum found = Minimise(pins, prior, WhitenedOf(prior, from), options);
    if (found.is_usable && (!best.is_usable || found.cost < best.cost)) best = found;
  }
  if (!best.is_usable) {
    solution.fault = "no camera near this place sees all pins in front of it";
    best.whitened.setZero();
  }
  solution.is_solved = best.is_usable;
  solution.parameters = prior.ParametersAt(best.whitened);
  if (best.is_usable) solution.tag = TagFromParameters(solution.parameters, tag);
  // One or two pins tell little of a camera that is only roughly known, whatever was held.
  solution.covariance = num_used < 3 ? all_known : PosteriorCovariance(pins, prior, best.whitened);
  solution.sigmas = solution.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  for (int i = 0; i < kNumCameraParameters; ++i) {
    solution.is_free[i] = solution.sigmas[i] < options.free_share * solution.prior_sigmas[i];
  }
  FillResiduals(pins, prior.ProjectionAt(best.whitened), options, solution);
  if (num_used >= 3) NameWorst(solution);
  return solution;
}

ViewTag TagToSave(const PinSolution& solution) {
  ViewTag tag = solution.tag;
  const TagDeviations deviations =
      TagDeviationsFromCovariance(solution.parameters, solution.covariance, tag);
  const auto of = [&](TagKey key) { return deviations[static_cast<size_t>(key)]; };
  const auto above_zero = [](double sigma) { return std::max(sigma, 1e-6); };
  tag.sigmas.position = above_zero(std::max(of(TagKey::kX), of(TagKey::kY)));
  tag.sigmas.height = above_zero(of(TagKey::kZ));
  tag.sigmas.lookat = above_zero(std::max({of(TagKey::kI), of(TagKey::kJ), of(TagKey::kK)}));
  tag.sigmas.roll_deg = above_zero(of(TagKey::kRoll));
  tag.sigmas.view_angle_deg = above_zero(of(TagKey::kV));
  tag.sigmas.aspect = above_zero(of(TagKey::kA));
  tag.sigmas.shift = above_zero(std::max(of(TagKey::kShiftX), of(TagKey::kShiftY)));
  tag.sigmas.k1 = above_zero(of(TagKey::kK1));
  return tag;
}

void RoughPlaceOptions::Check() const {
  const std::string name = "rough place options: ";
  CheckAbove(position_share, 0, name + "position_share");
  CheckAbove(height_share, 0, name + "height_share");
  CheckAbove(lookat_share, 0, name + "lookat_share");
  CheckAbove(roll_deg, 0, name + "roll_deg");
  CheckFromTo(view_angle_deg, 1, 179, name + "view_angle_deg");
  CheckAbove(view_angle_sigma_deg, 0, name + "view_angle_sigma_deg");
  CheckAbove(shift, 0, name + "shift");
  CheckAbove(cropped_shift, 0, name + "cropped_shift");
  CheckAbove(cropped_from, 0, name + "cropped_from");
}

bool IsOfCroppedPicture(const ViewTag& tag, const RoughPlaceOptions& options) {
  return tag.sigmas.shift && *tag.sigmas.shift > options.cropped_from;
}

ViewTag RoughTag(const Eigen::Vector3d& stood_in_world,
                 const Eigen::Vector3d& looked_in_world,
                 int width_px,
                 int height_px,
                 bool is_cropped,
                 const RoughPlaceOptions& options) {
  options.Check();
  const double distance = (looked_in_world - stood_in_world).norm();
  ViewTag tag;
  tag.position_in_site = SiteFromWorld(stood_in_world);
  tag.lookat_in_site = SiteFromWorld(looked_in_world);
  tag.aspect = static_cast<double>(width_px) / height_px;
  tag.view_angle_deg = options.view_angle_deg;
  tag.sigmas.position = options.position_share * distance;
  tag.sigmas.height = options.height_share * distance;
  tag.sigmas.lookat = options.lookat_share * distance;
  tag.sigmas.roll_deg = options.roll_deg;
  tag.sigmas.view_angle_deg = options.view_angle_sigma_deg;
  tag.sigmas.shift = is_cropped ? options.cropped_shift : options.shift;
  return tag;
}

}  // namespace groundglass
