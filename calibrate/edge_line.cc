// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/edge_line.h"

#include "scene/quantile.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace groundglass {
namespace {

constexpr int kMinCrossings = 6;
// Crossings farther than this many spreads from the line are dirt or a finger.
constexpr double kOutlierSpreads = 3.5;

}  // namespace

std::optional<EdgeLine> FitLine(std::vector<Eigen::Vector2d> points,
                                const Eigen::Vector2d& start,
                                const Eigen::Vector2d& end) {
  const Eigen::Vector2d along = (end - start).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  for (int round = 0;; ++round) {
    const double count = static_cast<double>(points.size());
    if (count < kMinCrossings) return std::nullopt;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& point : points) mean += point / count;
    double along_along = 0;
    double along_across = 0;
    for (const Eigen::Vector2d& point : points) {
      const double s = along.dot(point - mean);
      along_along += s * s;
      along_across += s * across.dot(point - mean);
    }
    const double slope = along_across / along_along;
    const auto distance = [&](const Eigen::Vector2d& point) {
      return std::abs(across.dot(point - mean) - slope * along.dot(point - mean));
    };
    std::vector<double> distances;
    for (const Eigen::Vector2d& point : points) distances.push_back(distance(point));
    const double spread = std::max(1.48 * UpperMedian(std::move(distances)), 0.02);
    const size_t removed = std::erase_if(points, [&](const Eigen::Vector2d& point) {
      return distance(point) > kOutlierSpreads * spread;
    });
    if (removed > 0 && round < 5) continue;

    EdgeLine line;
    line.normal = (across - slope * along).normalized();
    line.offset = line.normal.dot(mean);
    const double at_start = along.dot(start - mean);
    const double at_end = along.dot(end - mean);
    line.end_covariance.setConstant(1 / count);
    line.end_covariance(0, 0) += at_start * at_start / along_along;
    line.end_covariance(1, 1) += at_end * at_end / along_along;
    line.end_covariance(0, 1) += at_start * at_end / along_along;
    line.end_covariance(1, 0) = line.end_covariance(0, 1);
    return line;
  }
}

}  // namespace groundglass
