// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/notebook_overclaim.h"

#include "scene/check_option.h"
#include "scene/least_norm.h"
#include "scene/quantile.h"
#include "scene/symmetric_eigen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace groundglass {
namespace {

// The squared change of position and direction from the tag to the camera that was found, in the
// tag's sigmas, for each number that the photograph tells: about 1 where the tag's claim holds.
// What the photograph tells less well stays nearer to the tag, and counts less.
double RelativeSquaredChange(const CorrectedTag& camera) {
  constexpr int kNumOfPose = kRoll;  // position, yaw and pitch are the first
  const CameraPrior& written = *camera.written;
  const Eigen::MatrixXd root = written.root.topRows<kNumOfPose>();
  const Eigen::VectorXd change = root * written.WhitenedAt(camera.parameters);
  const SymmetricEigen posterior =
      DecomposeSymmetric(camera.covariance->topLeftCorner<kNumOfPose, kNumOfPose>());
  const Eigen::MatrixXd posterior_root =
      posterior.vectors * posterior.values.cwiseMax(0).cwiseSqrt().asDiagonal();
  const auto num_free =
      static_cast<double>((written.sigmas.head<kNumOfPose>().array() > 0).count());
  const double num_told = num_free - SolveLeastNorm(root, posterior_root).squaredNorm();
  return SolveLeastNorm(root, change).squaredNorm() / std::max(1.0, num_told);
}

// Half of all values of chi-squared with 5 degrees of freedom are less than this, divided by 5.
constexpr double kMedianOfRelativeChiSquared5 = 0.870;

}  // namespace

void OverclaimOptions::Check(const std::string& path) const {
  CheckAtLeast(least_overclaim, 1, path + "least_overclaim");
  CheckAtLeast(most_overclaim, 1, path + "most_overclaim");
  CheckAtLeast(least_photographs, 1, path + "least_photographs");
  CheckAtLeast(least_overclaim_of_set, 1, path + "least_overclaim_of_set");
  CheckAtLeast(least_photographs_of_set, 1, path + "least_photographs_of_set");
}

std::optional<double> MeasureOverclaim(const std::vector<CorrectedTag>& cameras) {
  if (cameras.empty()) return std::nullopt;
  std::vector<double> squared_changes;
  for (const CorrectedTag& camera : cameras) {
    squared_changes.push_back(RelativeSquaredChange(camera));
  }
  return std::sqrt(UpperMedian(std::move(squared_changes)) / kMedianOfRelativeChiSquared5);
}

std::optional<double> FindOverclaim(const std::vector<PhotographAlignment>& alignments,
                                    const OverclaimOptions& options) {
  std::vector<CorrectedTag> cameras;
  for (const PhotographAlignment& alignment : alignments) {
    if (!alignment.is_clear) continue;
    const AlignedPhotograph& aligned = alignment.aligned;
    cameras.push_back({&aligned.written,
                       aligned.prior.ParametersAt(aligned.whitened),
                       &alignment.registration.covariance});
  }
  if (static_cast<int>(cameras.size()) < options.least_photographs) return std::nullopt;
  const std::optional<double> overclaim = MeasureOverclaim(cameras);
  if (!overclaim || *overclaim < options.least_overclaim) return std::nullopt;
  return std::min(*overclaim, options.most_overclaim);
}

double OverclaimOfSet(const std::vector<CorrectedTag>& cameras, const OverclaimOptions& options) {
  if (static_cast<int>(cameras.size()) < options.least_photographs_of_set) return 1;
  const double overclaim = MeasureOverclaim(cameras).value_or(1);
  return overclaim < options.least_overclaim_of_set ? 1
                                                    : std::min(overclaim, options.most_overclaim);
}

std::string DescribeOverclaim(double overclaim) {
  return fmt::format(
      "the tags claim more than they hold: most photographs lie {:.1f} times further from "
      "them than their standard deviations allow, which were taken to be {:.1f} times "
      "larger; write larger sigma_position, sigma_height and sigma_lookat, or give "
      "--sigma-position, --sigma-height and --sigma-lookat",
      overclaim,
      overclaim);
}

}  // namespace groundglass
