// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/search/hypotheses.h"

#include "scene/check_option.h"
#include "scene/symmetric_eigen.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace groundglass {
namespace {

int BinOfNormal(const Eigen::Vector2d& normal, int num_bins) {
  double angle = std::atan2(normal.y(), normal.x());
  if (angle < 0) angle += std::numbers::pi;
  return static_cast<int>(std::lround(angle / std::numbers::pi * num_bins)) % num_bins;
}

// How much of an edge of each orientation a cell shows.
std::vector<cv::Mat> OrientationMaps(const EdgeEvidence::Level& level,
                                     const HypothesisOptions& options) {
  const int num_bins = options.num_orientations;
  const auto weakest = static_cast<float>(options.min_gradient);
  const auto half = static_cast<float>(options.half_weight_gradient);
  const ImageF& gradient = level.gradient;
  std::vector<cv::Mat> maps(num_bins);
  for (cv::Mat& map : maps) map = cv::Mat::zeros(gradient.height, gradient.width, CV_32F);
  for (int y = 1; y + 1 < gradient.height; ++y) {
    for (int x = 1; x + 1 < gradient.width; ++x) {
      const float* g = gradient.At(x, y);
      const float magnitude = std::hypot(g[0], g[1]);
      if (magnitude < weakest) continue;
      const float weight = magnitude / (magnitude + half);
      double angle = std::atan2(g[1], g[0]);
      if (angle < 0) angle += std::numbers::pi;
      const double position = angle / std::numbers::pi * num_bins;
      const int low = static_cast<int>(position) % num_bins;
      const auto fraction = static_cast<float>(position - std::floor(position));
      maps[low].at<float>(y, x) += weight * (1 - fraction);
      maps[(low + 1) % num_bins].at<float>(y, x) += weight * fraction;
    }
  }
  return maps;
}

// For each orientation, log(1 - s + s m / mean m), s the share of an edge that is shown: m is how
// much of an edge of that orientation lies about a cell. The average cell scores near zero, so more
// edges everywhere do not help.
class ScoreMaps {
 public:
  // scale: px of the photograph for each cell.
  ScoreMaps(const std::vector<cv::Mat>& orientations,
            double scale,
            double blur_cells,
            const HypothesisOptions& options)
      : scale_(scale), width_(orientations.front().cols), height_(orientations.front().rows) {
    const auto shown = static_cast<float>(options.shown_share);
    const auto num_cells = static_cast<Eigen::Index>(width_) * height_;
    values_.resize(orientations.size() * static_cast<size_t>(num_cells));
    float* values = values_.data();
    for (const cv::Mat& map : orientations) {
      cv::Mat soft;
      cv::GaussianBlur(map, soft, {0, 0}, blur_cells, blur_cells, cv::BORDER_REPLICATE);
      const double mean = std::max(1e-6, cv::mean(soft)[0]);
      const Eigen::Map<const Eigen::ArrayXf> found(soft.ptr<float>(), num_cells);
      // Eigen takes several logarithms at a time: one by one they are a quarter of registration.
      Eigen::Map<Eigen::ArrayXf>(values, num_cells) =
          (found * (shown / static_cast<float>(mean)) + (1 - shown)).log();
      values += num_cells;
    }
  }

  double scale() const { return scale_; }

  float At(int bin, double x_px, double y_px) const {
    const int x = static_cast<int>(x_px / scale_);
    const int y = static_cast<int>(y_px / scale_);
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return 0;
    return values_[(static_cast<size_t>(bin) * height_ + y) * width_ + x];
  }

 private:
  double scale_;
  int width_;
  int height_;
  std::vector<float> values_;
};

// The samples, moved linearly by the leading directions.
struct LinearSamples {
  std::vector<Eigen::Vector2d> image_px;
  std::vector<int> bins;
  std::vector<float> observations;
  // 2N x 11: displacement in px for one standard deviation of each leading direction.
  Eigen::Matrix<double, Eigen::Dynamic, kNumCameraParameters> moves;
  // How far a loose model's edges may lie off, one sigma, root mean square, px.
  double loose_px = 0;
  // Root mean square of the displacement along the normals, px per standard deviation.
  CameraParameters rms_px;
  // Columns: the leading directions in whitened parameters.
  CameraCovariance directions;
};

LinearSamples Linearise(const std::vector<EdgeSample>& samples,
                        const CameraPrior& prior,
                        const HypothesisOptions& options) {
  const ParameterProjection projection = prior.ProjectionAt(CameraParameters::Zero());
  LinearSamples linear;
  std::vector<Eigen::Matrix<double, 2, kNumCameraParameters>> by_whitened;
  CameraCovariance information = CameraCovariance::Zero();
  double loose_sum = 0;
  for (const EdgeSample& sample : samples) {
    const auto projected = ProjectSamples({sample}, projection)[0];
    if (!projected.is_valid) continue;
    const auto full = projection.Project(sample.point_in_world);
    linear.image_px.push_back(projected.image_px);
    linear.bins.push_back(BinOfNormal(projected.normal, options.num_orientations));
    linear.observations.push_back(
        static_cast<float>(sample.spacing_px / options.observation_length_px));
    by_whitened.push_back(full->jacobian * prior.root);
    loose_sum += std::pow(sample.looseness * projected.px_per_unit, 2);
    const Eigen::Matrix<double, 1, kNumCameraParameters> across =
        projected.normal.transpose() * by_whitened.back();
    information += across.transpose() * across;
  }
  const double count = std::max<double>(1, static_cast<double>(by_whitened.size()));
  linear.loose_px = std::sqrt(loose_sum / count);
  const SymmetricEigen eigen = DecomposeSymmetric(information / count);
  linear.directions = eigen.vectors.rowwise().reverse();
  linear.rms_px = eigen.values.reverse().cwiseMax(0).cwiseSqrt();
  linear.moves.resize(2 * static_cast<Eigen::Index>(by_whitened.size()), kNumCameraParameters);
  for (size_t i = 0; i < by_whitened.size(); ++i) {
    linear.moves.middleRows<2>(2 * static_cast<Eigen::Index>(i)) =
        by_whitened[i] * linear.directions;
  }
  return linear;
}

// Log score of the samples displaced by `coefficients` of the leading directions, and the prior's.
double ScoreAt(const LinearSamples& linear, const ScoreMaps& maps, const CameraParameters& c) {
  double score = -0.5 * c.squaredNorm();
  // Directions that do not count are exactly zero: skip them.
  int last = kNumCameraParameters;
  while (last > 0 && c[last - 1] == 0) --last;
  for (size_t i = 0; i < linear.image_px.size(); ++i) {
    double x = linear.image_px[i].x();
    double y = linear.image_px[i].y();
    for (int k = 0; k < last; ++k) {
      x += linear.moves(2 * static_cast<Eigen::Index>(i), k) * c[k];
      y += linear.moves(2 * static_cast<Eigen::Index>(i) + 1, k) * c[k];
    }
    score += linear.observations[i] * maps.At(linear.bins[i], x, y);
  }
  return score;
}

// The points of a grid over the leading directions, inside the prior's ellipsoid. The outermost
// loop runs over the weakest direction, so neighbours in the list are neighbours in the image.
// Where the prior reaches very far the points are too many to be held: no more than a few above
// the limit ever are.
std::vector<CameraParameters> MakeGrid(const LinearSamples& linear,
                                       double step_px,
                                       const HypothesisOptions& options) {
  for (;; step_px *= options.step_growth) {
    std::vector<CameraParameters> grid = {CameraParameters::Zero()};
    bool too_many = false;
    for (int k = 0; k < kNumCameraParameters && !too_many; ++k) {
      const double reach_px = options.reach_sigmas * linear.rms_px[k];
      if (reach_px > step_px * options.max_grid_points) {
        too_many = true;
        break;
      }
      const int steps = static_cast<int>(reach_px / step_px);
      if (steps == 0) continue;
      std::vector<CameraParameters> wider;
      for (const CameraParameters& point : grid) {
        if (static_cast<int>(wider.size()) > options.max_grid_points) break;
        for (int i = -steps; i <= steps; ++i) {
          CameraParameters moved = point;
          moved[k] = i * step_px / linear.rms_px[k];
          if (moved.norm() > options.reach_sigmas * options.corner_reach) continue;
          wider.push_back(moved);
        }
      }
      grid = std::move(wider);
      too_many = static_cast<int>(grid.size()) > options.max_grid_points;
    }
    if (!too_many) return grid;
  }
}

double DistancePx(const LinearSamples& linear, const CameraParameters& difference) {
  return difference.cwiseProduct(linear.rms_px).norm();
}

struct ScoredPoint {
  CameraParameters coefficients;
  double score;
};

void SortBestFirst(std::vector<ScoredPoint>& points) {
  std::stable_sort(points.begin(), points.end(), [](const ScoredPoint& a, const ScoredPoint& b) {
    return a.score > b.score;
  });
}

// Keeps the best points that lie apart.
std::vector<ScoredPoint> KeepDistinct(const LinearSamples& linear,
                                      std::vector<ScoredPoint> points,
                                      double distance_px,
                                      size_t count) {
  SortBestFirst(points);
  std::vector<ScoredPoint> kept;
  for (const ScoredPoint& point : points) {
    const bool is_distinct = std::none_of(kept.begin(), kept.end(), [&](const ScoredPoint& other) {
      return DistancePx(linear, point.coefficients - other.coefficients) < distance_px;
    });
    if (is_distinct) kept.push_back(point);
    if (kept.size() == count) break;
  }
  return kept;
}

// Coordinate ascent over the leading directions with halving steps.
void Climb(const LinearSamples& linear,
           const ScoreMaps& maps,
           double step_px,
           const HypothesisOptions& options,
           ScoredPoint& point) {
  point.score = ScoreAt(linear, maps, point.coefficients);
  for (; step_px > options.least_climb_step_cells * maps.scale(); step_px /= 2) {
    for (int round = 0; round < options.climb_rounds; ++round) {
      bool improved = false;
      for (int k = 0; k < kNumCameraParameters; ++k) {
        if (linear.rms_px[k] * options.climb_reach_sigmas < step_px) continue;
        for (const double sign : {-1.0, 1.0}) {
          ScoredPoint moved = point;
          moved.coefficients[k] += sign * step_px / linear.rms_px[k];
          moved.score = ScoreAt(linear, maps, moved.coefficients);
          if (moved.score > point.score) {
            point = moved;
            improved = true;
          }
        }
      }
      if (!improved) break;
    }
  }
}

}  // namespace

void HypothesisOptions::Check(const std::string& path) const {
  CheckFromTo(reach_sigmas, 0.1, 20, path + "reach_sigmas");
  CheckFromTo(width_cells, 16, 10000, path + "width_cells");
  CheckFromTo(step_cells, 0.1, 100, path + "step_cells");
  CheckFromTo(max_grid_points, 1, 100000000, path + "max_grid_points");
  CheckFromTo(max_starts, 0, 1000, path + "max_starts");
  CheckFromTo(distinct_cells, 0, 100, path + "distinct_cells");
  CheckAtLeast(again_below_nats_per_observation, 0, path + "again_below_nats_per_observation");
  CheckFromTo(max_rounds, 1, 20, path + "max_rounds");
  CheckFromTo(num_centres, 1, 1000, path + "num_centres");
  CheckAbove(observation_length_px, 0, path + "observation_length_px");
  CheckFromTo(num_orientations, 1, 180, path + "num_orientations");
  CheckAbove(grid_blur_steps, 0, path + "grid_blur_steps");
  CheckAbove(climb_blur_cells, 0, path + "climb_blur_cells");
  CheckFromTo(step_growth, 1.01, 10, path + "step_growth");
  CheckFromTo(corner_reach, 1, 10, path + "corner_reach");
  CheckAtLeast(climb_distinct_steps, 0, path + "climb_distinct_steps");
  CheckFromTo(climbs_per_start, 1, 1000, path + "climbs_per_start");
  CheckFromTo(least_climb_step_cells, 0.001, 100, path + "least_climb_step_cells");
  CheckFromTo(climb_rounds, 1, 1000, path + "climb_rounds");
  CheckAbove(climb_reach_sigmas, 0, path + "climb_reach_sigmas");
  CheckFromTo(shown_share, 0.01, 0.99, path + "shown_share");
  CheckAtLeast(min_gradient, 0, path + "min_gradient");
  CheckAbove(half_weight_gradient, 0, path + "half_weight_gradient");
}

std::vector<Hypothesis> FindHypotheses(const std::vector<EdgeSample>& samples,
                                       const CameraPrior& prior,
                                       const EdgeEvidence& evidence,
                                       const HypothesisOptions& options) {
  const LinearSamples linear = Linearise(samples, prior, options);
  const double px_per_cell = static_cast<double>(prior.width_px) / options.width_cells;
  const EdgeEvidence::Level& level = evidence.AtScale(px_per_cell * 1.01);
  const double loose_cells = linear.loose_px / level.scale;
  const std::vector<cv::Mat> orientations = OrientationMaps(level, options);
  const ScoreMaps coarse(orientations,
                         level.scale,
                         std::hypot(options.step_cells * options.grid_blur_steps, loose_cells),
                         options);
  const ScoreMaps fine(
      orientations, level.scale, std::hypot(options.climb_blur_cells, loose_cells), options);

  std::vector<ScoredPoint> points;
  for (const CameraParameters& coefficients :
       MakeGrid(linear, options.step_cells * coarse.scale(), options)) {
    points.push_back({coefficients, ScoreAt(linear, coarse, coefficients)});
  }
  const double step_px = options.step_cells * coarse.scale();
  points = KeepDistinct(linear,
                        std::move(points),
                        options.climb_distinct_steps * step_px,
                        static_cast<size_t>(options.climbs_per_start) * options.max_starts);
  for (ScoredPoint& point : points) Climb(linear, fine, step_px / 2, options, point);
  points = KeepDistinct(linear,
                        std::move(points),
                        options.distinct_cells * fine.scale(),
                        static_cast<size_t>(options.max_starts));

  std::vector<Hypothesis> hypotheses;
  for (const ScoredPoint& point : points) {
    hypotheses.push_back({linear.directions * point.coefficients, point.score});
  }
  // Where the tag is a peak of the score, it is among them already.
  std::erase_if(hypotheses, [](const Hypothesis& one) { return one.whitened.isZero(0); });
  hypotheses.push_back({CameraParameters::Zero(), ScoreAt(linear, fine, CameraParameters::Zero())});
  return hypotheses;
}

double PriorNonlinearity(const std::vector<EdgeSample>& samples, const CameraPrior& prior) {
  const auto project = [&](const CameraParameters& whitened) {
    return ProjectSamples(samples, prior.ProjectionAt(whitened));
  };
  const std::vector<ProjectedSample> middle = project(CameraParameters::Zero());
  double sum = 0;
  int count = 0;
  for (int k = 0; k < kNumCameraParameters; ++k) {
    const std::vector<ProjectedSample> ahead = project(2 * CameraParameters::Unit(k));
    const std::vector<ProjectedSample> behind = project(-2 * CameraParameters::Unit(k));
    for (size_t i = 0; i < samples.size(); ++i) {
      count += k == 0;
      if (!middle[i].is_valid || !ahead[i].is_valid || !behind[i].is_valid) continue;
      sum += ((ahead[i].image_px + behind[i].image_px) / 2 - middle[i].image_px).squaredNorm();
    }
  }
  return std::sqrt(sum / std::max(1, count));
}

}  // namespace groundglass
