// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/camera/camera_prior.h"

#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/model_sigma.h"
#include "scene/symmetric_eigen.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// What a tape and a tripod leave uncertain.
constexpr double kPositionMetres = 0.076;
constexpr double kHeightMetres = 0.030;
constexpr double kLookatMetres = 0.122;
constexpr double kBestOfRulersMetres = 0.001;
// A direction whose squared length is less than this, in sigmas, is none.
constexpr double kSingular = 1e-20;

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Whether names of kCameraParameterNames, or "shift" for both, have this parameter among them.
bool IsNamed(const std::vector<std::string>& names, CameraParameter parameter) {
  const bool is_shift = parameter == kShiftX || parameter == kShiftY;
  return Contains(names, std::string(kCameraParameterNames[parameter])) ||
         (is_shift && Contains(names, "shift"));
}

void RequireParameterNames(const std::vector<std::string>& names, const std::string& option) {
  for (const std::string& name : names) {
    if (name == "shift") continue;
    if (std::find(kCameraParameterNames.begin(), kCameraParameterNames.end(), name) ==
        kCameraParameterNames.end()) {
      throw OptionError("option " + option + ":",
                        "no parameter is called '" + name +
                            "'; there are x y z yaw pitch roll v a shift shift_x shift_y k1");
    }
  }
}

// What the tag says of its own numbers, without those that are to be free.
TagSigmas SigmasThatHold(TagSigmas sigmas, const std::vector<std::string>& free) {
  for (const std::string& name : free) {
    if (name == "x" || name == "y") sigmas.position.reset();
    if (name == "z") sigmas.height.reset();
    if (name == "yaw" || name == "pitch") sigmas.lookat.reset();
    if (name == "roll") sigmas.roll_deg.reset();
    if (name == "v") sigmas.view_angle_deg.reset();
    if (name == "a") sigmas.aspect.reset();
    if (name.starts_with("shift")) sigmas.shift.reset();
    if (name == "k1") sigmas.k1.reset();
  }
  return sigmas;
}

// The six numbers that a tape measures: position and look-at point, in `site`.
constexpr int kNumMeasured = 6;
using MeasuredSigmas = Eigen::Matrix<double, kNumMeasured, 1>;
// Position, yaw and pitch follow from them: the first of CameraParameters.
constexpr int kNumPose = 5;

// One standard deviation each, in the model's unit: the tag's own, else the length that was given,
// else the larger of a tape's and a share of the distance.
MeasuredSigmas SigmasOfMeasured(const ViewTag& tag,
                                const TagSigmas& noted,
                                LengthUnit unit,
                                const PriorOptions& options) {
  const double units_per_metre = 1 / MetresPerUnit(unit);
  const double distance = (tag.lookat_in_site - tag.position_in_site).norm();
  const auto length_sigma = [&](const std::optional<double>& own,
                                const std::optional<double>& given_m,
                                double tape_m,
                                double share) {
    if (own) return *own;
    if (given_m) return *given_m * units_per_metre;
    return std::max(tape_m * units_per_metre, share * distance);
  };
  const double position = length_sigma(
      noted.position, options.position_m, options.OwnPositionMetres(), options.position_share);
  const double height =
      length_sigma(noted.height, options.height_m, options.OwnHeightMetres(), options.height_share);
  const double lookat =
      length_sigma(noted.lookat, options.lookat_m, options.OwnLookatMetres(), options.lookat_share);
  MeasuredSigmas sigmas;
  sigmas << position, position, height, lookat, lookat, lookat;
  return sigmas;
}

// d (position, yaw, pitch) / d (position, look-at point): finite differences of the tag itself.
Eigen::Matrix<double, kNumPose, kNumMeasured> PoseByMeasured(const ViewTag& tag) {
  const double step = 1e-5 * (tag.lookat_in_site - tag.position_in_site).norm();
  Eigen::Matrix<double, kNumPose, kNumMeasured> by_measured;
  for (int column = 0; column < kNumMeasured; ++column) {
    ViewTag ahead = tag;
    ViewTag behind = tag;
    (column < 3 ? ahead.position_in_site[column] : ahead.lookat_in_site[column - 3]) += step;
    (column < 3 ? behind.position_in_site[column] : behind.lookat_in_site[column - 3]) -= step;
    Eigen::Matrix<double, kNumPose, 1> change =
        (ParametersFromTag(ahead) - ParametersFromTag(behind)).head<kNumPose>();
    change[kYaw] = std::remainder(change[kYaw], 360.0);
    by_measured.col(column) = change / (2 * step);
  }
  return by_measured;
}

// What is known of lens and slide, in the order of CameraParameters: one standard deviation each of
// roll, view angle, aspect, shift x, shift y and k1.
constexpr int kNumLensAndSlide = 6;
using LensAndSlideSigmas = Eigen::Matrix<double, kNumLensAndSlide, 1>;

LensAndSlideSigmas SigmasOfTag(const ViewTag& tag,
                               const TagSigmas& noted,
                               const PriorOptions& options) {
  const double shift = noted.shift.value_or(options.OwnShift());
  LensAndSlideSigmas sigmas;
  sigmas << noted.roll_deg.value_or(options.roll_deg),
      noted.view_angle_deg.value_or(options.view_angle_share * tag.view_angle_deg),
      noted.aspect.value_or(options.aspect_share * tag.aspect), shift, shift,
      noted.k1.value_or(options.k1);
  return sigmas;
}

// The same where the lens is calibrated: its own uncertainty, and on top of it, unless the
// photograph is digital, what mount and scan do. Parameters that are to be free are at least as
// uncertain as the options say.
LensAndSlideSigmas SigmasOfLens(const Lens& lens, double roll_deg, const PriorOptions& options) {
  // A scale error of the mount changes the tangent of half the view angle.
  const double view_angle_by_scale =
      DegreesFromRadians(std::sin(RadiansFromDegrees(lens.view_angle_deg)));
  const double slide = options.digital ? 0 : 1;
  LensAndSlideSigmas sigmas;
  sigmas << roll_deg,
      std::hypot(lens.sigma_view_angle_deg,
                 slide * options.slide_scale_share * view_angle_by_scale),
      std::hypot(lens.sigma_aspect, slide * options.slide_aspect_share * lens.aspect),
      std::hypot(lens.sigma_shift_x, slide * options.OwnShift()),
      std::hypot(lens.sigma_shift_y, slide * options.OwnShift()), lens.sigma_k1;
  const auto free_at_least = [&](CameraParameter parameter, double own) {
    if (!IsNamed(options.free, parameter)) return;
    double& sigma = sigmas[parameter - kRoll];
    sigma = std::max(sigma, own);
  };
  free_at_least(kViewAngle, options.view_angle_share * lens.view_angle_deg);
  free_at_least(kAspect, options.aspect_share * lens.aspect);
  free_at_least(kShiftX, options.OwnShift());
  free_at_least(kShiftY, options.OwnShift());
  free_at_least(kK1, options.k1);
  return sigmas;
}

// What a calibrated lens says takes the place of what the tag says of it.
void TakeLens(const Lens& lens, CameraPrior& prior) {
  prior.mean[kViewAngle] = lens.view_angle_deg;
  prior.mean[kAspect] = lens.aspect;
  prior.mean[kShiftX] = lens.shift_x;
  prior.mean[kShiftY] = lens.shift_y;
  prior.mean[kK1] = lens.k1;
  prior.measured.k2 = lens.k2;
  prior.measured.k3 = lens.k3;
  prior.measured.p1 = lens.p1;
  prior.measured.p2 = lens.p2;
}

void TakeSquarePixels(const PriorOptions& options, CameraPrior& prior, LensAndSlideSigmas& sigmas) {
  const double of_frame = static_cast<double>(prior.width_px) / prior.height_px;
  const double written = prior.mean[kAspect];
  if (std::abs(written / of_frame - 1) > options.rounded_aspect_share) return;
  prior.mean[kAspect] = of_frame;
  sigmas[kAspect - kRoll] = options.digital_aspect_share * of_frame;
}

void LockParameters(const std::vector<std::string>& names, CameraCovariance& covariance) {
  for (int i = 0; i < kNumCameraParameters; ++i) {
    if (!IsNamed(names, static_cast<CameraParameter>(i))) continue;
    covariance.row(i).setZero();
    covariance.col(i).setZero();
  }
}

// A square root that allows locked parameters: of the correlations, so that units do not matter.
void SetCovariance(const CameraCovariance& covariance, CameraPrior& prior) {
  prior.sigmas = covariance.diagonal().cwiseSqrt();
  CameraParameters inverse_sigmas = CameraParameters::Zero();
  for (int i = 0; i < kNumCameraParameters; ++i) {
    if (prior.sigmas[i] > 0) inverse_sigmas[i] = 1 / prior.sigmas[i];
  }
  const CameraCovariance correlation =
      inverse_sigmas.asDiagonal() * covariance * inverse_sigmas.asDiagonal();
  const SymmetricEigen eigen = DecomposeSymmetric(correlation);
  prior.root =
      prior.sigmas.asDiagonal() * eigen.vectors * eigen.values.cwiseMax(0).cwiseSqrt().asDiagonal();
}

}  // namespace

void PriorOptions::Check() const {
  const auto require_positive = [](double value, const char* name) {
    CheckFinite(value, std::string("option ") + name + ":");
    if (!(value > 0)) {
      throw OptionError(std::string("option ") + name + ":",
                        "a standard deviation must be above 0, not " + FormatNumber(value));
    }
  };
  if (position_m) require_positive(*position_m, "sigma-position");
  CheckAtLeast(position_share, 0, "prior options: position_share");
  if (height_m) require_positive(*height_m, "sigma-height");
  CheckAtLeast(height_share, 0, "prior options: height_share");
  if (lookat_m) require_positive(*lookat_m, "sigma-lookat");
  CheckAtLeast(lookat_share, 0, "prior options: lookat_share");
  CheckAbove(tape_scale, 0, "prior options: tape_scale");
  require_positive(roll_deg, "sigma-roll");
  require_positive(view_angle_share, "sigma-v");
  require_positive(aspect_share, "sigma-a");
  if (shift) require_positive(*shift, "sigma-shift");
  require_positive(slide_shift, "slide_shift");
  require_positive(digital_shift, "digital_shift");
  require_positive(k1, "sigma-k1");
  CheckAtLeast(slide_scale_share, 0, "prior options: slide_scale_share");
  CheckAtLeast(slide_aspect_share, 0, "prior options: slide_aspect_share");
  require_positive(digital_aspect_share, "digital_aspect_share");
  CheckAtLeast(rounded_aspect_share, 0, "prior options: rounded_aspect_share");
  CheckFromTo(overclaim, 1, 1e6, "prior options: overclaim");
  RequireParameterNames(lock, "lock");
  RequireParameterNames(free, "free");
  for (const std::string& name : free) {
    if (Contains(lock, name)) {
      throw OptionError("options lock and free:", "'" + name + "' is in both");
    }
  }
}

double PriorOptions::OwnPositionMetres() const {
  return std::max(tape_scale * kPositionMetres, kBestOfRulersMetres);
}

double PriorOptions::OwnHeightMetres() const {
  return std::max(tape_scale * kHeightMetres, kBestOfRulersMetres);
}

double PriorOptions::OwnLookatMetres() const {
  return std::max(tape_scale * kLookatMetres, kBestOfRulersMetres);
}

PriorOptions PriorSuitedTo(const PolygonModel& model, PriorOptions options) {
  options.tape_scale = ModelScale(model);
  return options;
}

Camera CameraPrior::CameraAt(const CameraParameters& whitened) const {
  return CameraFromTag(TagFromParameters(ParametersAt(whitened), measured), width_px, height_px);
}

CameraParameters CameraPrior::WhitenedAt(const CameraParameters& parameters) const {
  CameraParameters change = parameters - mean;
  change[kYaw] = std::remainder(change[kYaw], 360.0);
  // In units of the sigmas the columns of the root are orthogonal (SetCovariance).
  CameraCovariance root_in_sigmas = CameraCovariance::Zero();
  for (int i = 0; i < kNumCameraParameters; ++i) {
    if (!(sigmas[i] > 0)) {
      change[i] = 0;
      continue;
    }
    root_in_sigmas.row(i) = root.row(i) / sigmas[i];
    change[i] /= sigmas[i];
  }
  CameraParameters whitened = CameraParameters::Zero();
  for (int k = 0; k < kNumCameraParameters; ++k) {
    const double squared_length = root_in_sigmas.col(k).squaredNorm();
    if (squared_length > kSingular)
      whitened[k] = root_in_sigmas.col(k).dot(change) / squared_length;
  }
  return whitened;
}

CameraPrior WithWiderPose(const CameraPrior& prior, double factor) {
  CameraPrior wider = prior;
  CameraParameters scale = CameraParameters::Ones();
  scale.head<kNumPose>().setConstant(factor);
  // Position and direction do not depend on the rest, so their rows can be scaled by themselves.
  wider.root = scale.asDiagonal() * prior.root;
  wider.sigmas = scale.cwiseProduct(prior.sigmas);
  return wider;
}

CameraPrior MakeCameraPrior(const ViewTag& tag,
                            int width_px,
                            int height_px,
                            LengthUnit unit,
                            const std::optional<Lens>& lens,
                            const PriorOptions& options) {
  CameraPrior prior;
  prior.measured = tag;
  prior.width_px = width_px;
  prior.height_px = height_px;
  prior.mean = ParametersFromTag(tag);
  if (lens) TakeLens(*lens, prior);

  const TagSigmas noted = SigmasThatHold(tag.sigmas, options.free);
  const Eigen::Matrix<double, kNumPose, kNumMeasured> pose_root =
      PoseByMeasured(tag) * SigmasOfMeasured(tag, noted, unit, options).asDiagonal();
  LensAndSlideSigmas lens_and_slide = SigmasOfTag(tag, noted, options);
  if (lens) {
    lens_and_slide = SigmasOfLens(*lens, lens_and_slide[0], options);
  } else if (options.digital && !noted.aspect && !IsNamed(options.free, kAspect)) {
    TakeSquarePixels(options, prior, lens_and_slide);
  }

  CameraCovariance covariance = CameraCovariance::Zero();
  covariance.topLeftCorner<kNumPose, kNumPose>() = pose_root * pose_root.transpose();
  covariance.diagonal().tail<kNumLensAndSlide>() = lens_and_slide.cwiseAbs2();
  LockParameters(options.lock, covariance);
  SetCovariance(covariance, prior);
  return options.overclaim == 1 ? prior : WithWiderPose(prior, options.overclaim);
}

}  // namespace groundglass
