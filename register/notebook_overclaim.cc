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
double RelativeSquaredChange(const PhotographAlignment& alignment) {
  constexpr int kNumOfPose = kRoll;  // position, yaw and pitch are the first
  const AlignedPhotograph& aligned = alignment.aligned;
  const CameraPrior& written = aligned.written;
  const Eigen::MatrixXd root = written.root.topRows<kNumOfPose>();
  const Eigen::VectorXd change =
      root * written.WhitenedAt(aligned.prior.ParametersAt(aligned.whitened));
  const SymmetricEigen posterior =
      DecomposeSymmetric(alignment.registration.covariance.topLeftCorner<kNumOfPose, kNumOfPose>());
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
}

std::optional<double> FindOverclaim(const std::vector<PhotographAlignment>& alignments,
                                    const OverclaimOptions& options) {
  std::vector<double> squared_changes;
  for (const PhotographAlignment& alignment : alignments) {
    if (alignment.is_clear) squared_changes.push_back(RelativeSquaredChange(alignment));
  }
  if (static_cast<int>(squared_changes.size()) < options.least_photographs) return std::nullopt;
  const double overclaim =
      std::sqrt(UpperMedian(std::move(squared_changes)) / kMedianOfRelativeChiSquared5);
  if (overclaim < options.least_overclaim) return std::nullopt;
  return std::min(overclaim, options.most_overclaim);
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
