// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/match_patch.h"

#include "scene/check_option.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include <cmath>

namespace groundglass {
namespace {

cv::Mat MatOf(const ImageF& image) {
  return {image.height, image.width, CV_32FC1, const_cast<float*>(image.values.data())};
}

// The best place among all whole offsets, from the surroundings' top left; nothing if it is not the
// only one.
std::optional<cv::Point> FindWholeOffset(const cv::Mat& patch,
                                         const cv::Mat& surroundings,
                                         const PatchMatchOptions& options) {
  cv::Mat correlation;
  cv::matchTemplate(surroundings, patch, correlation, cv::TM_CCOEFF_NORMED);
  double best = 0;
  cv::Point at;
  cv::minMaxLoc(correlation, nullptr, &best, nullptr, &at);
  // Whole texels lose part of the correlation of fine detail.
  if (!(best >= options.min_correlation - options.min_lead)) return std::nullopt;
  if (at.x == 0 || at.y == 0 || at.x == correlation.cols - 1 || at.y == correlation.rows - 1) {
    return std::nullopt;
  }
  const cv::Rect peak(at.x - options.peak_texels,
                      at.y - options.peak_texels,
                      2 * options.peak_texels + 1,
                      2 * options.peak_texels + 1);
  correlation(peak & cv::Rect({}, correlation.size())).setTo(-1);
  double second = 0;
  cv::minMaxLoc(correlation, nullptr, &second);
  if (second > best - options.min_lead) return std::nullopt;
  return at;
}

// How well the patch lies at an offset of parts of texels, by its gradients and by what is left.
Eigen::Matrix2d OffsetCovariance(const cv::Mat& patch,
                                 double correlation,
                                 const PatchMatchOptions& options) {
  cv::Mat by_x, by_y;
  cv::Sobel(patch, by_x, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(patch, by_y, CV_32F, 0, 1, 3, 1.0 / 8);
  Eigen::Matrix2d information;
  information(0, 0) = by_x.dot(by_x);
  information(1, 1) = by_y.dot(by_y);
  information(0, 1) = information(1, 0) = by_x.dot(by_y);
  cv::Scalar mean, deviation;
  cv::meanStdDev(patch, mean, deviation);
  const double unexplained = (1 - correlation * correlation) * deviation[0] * deviation[0];
  const double floor = options.floor_texels * options.floor_texels;
  return options.correlated_texels * unexplained *
             (information + 1e-12 * Eigen::Matrix2d::Identity()).inverse() +
         floor * Eigen::Matrix2d::Identity();
}

}  // namespace

void PatchMatchOptions::Check(const std::string& path) const {
  CheckFromTo(min_correlation, 0, 1, path + "min_correlation");
  CheckFromTo(min_lead, 0, 1, path + "min_lead");
  CheckFromTo(peak_texels, 1, 100, path + "peak_texels");
  CheckAbove(max_sigma_texels, 0, path + "max_sigma_texels");
  CheckAbove(correlated_texels, 0, path + "correlated_texels");
  CheckAbove(floor_texels, 0, path + "floor_texels");
}

std::optional<PatchMatch> MatchPatch(const ImageF& patch,
                                     const ImageF& surroundings,
                                     const PatchMatchOptions& options) {
  const cv::Mat small = MatOf(patch);
  const cv::Mat large = MatOf(surroundings);
  const std::optional<cv::Point> whole = FindWholeOffset(small, large, options);
  if (!whole) return std::nullopt;
  cv::Mat warp = (cv::Mat_<float>(2, 3) << 1, 0, whole->x, 0, 1, whole->y);
  double correlation = 0;
  try {
    correlation = cv::findTransformECC(small,
                                       large,
                                       warp,
                                       cv::MOTION_TRANSLATION,
                                       {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 15, 1e-4},
                                       cv::noArray(),
                                       1);
  } catch (const cv::Exception&) {
    return std::nullopt;  // it does not converge: the patch is not there
  }
  PatchMatch match;
  match.correlation = correlation;
  const Eigen::Vector2d from_whole(warp.at<float>(0, 2) - whole->x,
                                   warp.at<float>(1, 2) - whole->y);
  match.offset_texels =
      from_whole + Eigen::Vector2d(whole->x, whole->y) -
      0.5 * Eigen::Vector2d(surroundings.width - patch.width, surroundings.height - patch.height);
  match.covariance = OffsetCovariance(small, correlation, options);
  const Eigen::Matrix2d& spread = match.covariance;
  const double worst =
      0.5 * spread.trace() + std::hypot(0.5 * (spread(0, 0) - spread(1, 1)), spread(0, 1));
  const bool is_good = correlation >= options.min_correlation &&
                       from_whole.lpNorm<Eigen::Infinity>() < options.peak_texels &&
                       worst < options.max_sigma_texels * options.max_sigma_texels;
  return is_good ? std::optional(match) : std::nullopt;
}

}  // namespace groundglass
