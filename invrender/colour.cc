// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/colour.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// A cell that several photographs show.
struct Overlap {
  int chart;
  int cell;
};

std::vector<Overlap> FindOverlaps(const std::vector<ChartCells>& cells) {
  constexpr size_t kEnough = 60000;
  std::vector<Overlap> overlaps;
  for (size_t chart = 0; chart < cells.size(); ++chart) {
    for (int cell = 0; cell < cells[chart].NumCells(); ++cell) {
      const CellView* views = cells[chart].ViewsOf(cell);
      int count = 0;
      for (size_t k = 0; k < cells[chart].photos.size(); ++k) count += views[k].is_usable ? 1 : 0;
      if (count >= 2) overlaps.push_back({static_cast<int>(chart), cell});
    }
  }
  if (overlaps.size() <= kEnough) return overlaps;
  std::vector<Overlap> thinned;
  for (size_t i = 0; i < kEnough; ++i) thinned.push_back(overlaps[i * overlaps.size() / kEnough]);
  return thinned;
}

// The smallest value with half of the weight at or below it.
float WeightedMedian(std::vector<std::pair<float, float>>& value_and_weight) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double total = 0;
  for (const auto& [value, weight] : value_and_weight) total += weight;
  double sum = 0;
  for (const auto& [value, weight] : value_and_weight) {
    sum += weight;
    if (sum >= total / 2) return value;
  }
  return 0;
}

// One gain and one vignetting for each photograph, one channel at a time.
void SolveGains(const std::vector<ChartCells>& cells,
                const std::vector<Overlap>& overlaps,
                int channel,
                std::vector<ColourModel::Photo>& photos) {
  const int num_photos = static_cast<int>(photos.size());
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(2 * num_photos);
  struct Row {
    int photo;
    double radius_squared;
    double value;
    double weight;
  };
  std::vector<Row> rows;
  for (const double scale : {1.0, 0.6, 0.4, 0.25, 0.18, 0.15, 0.15, 0.15}) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(2 * num_photos, 2 * num_photos);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * num_photos);
    for (const Overlap& overlap : overlaps) {
      const ChartCells& chart = cells[overlap.chart];
      const CellView* views = chart.ViewsOf(overlap.cell);
      rows.clear();
      for (size_t k = 0; k < chart.photos.size(); ++k) {
        if (!views[k].is_usable) continue;
        rows.push_back(
            {chart.photos[k], views[k].radius_squared, views[k].log_radiance[channel], 1.0});
      }
      const auto residual = [&](const Row& row) {
        return row.value - solution[2 * row.photo] -
               solution[2 * row.photo + 1] * row.radius_squared;
      };
      // The cell's colour under the current gains: the middle one.
      std::vector<double> residuals;
      for (const Row& row : rows) residuals.push_back(residual(row));
      std::sort(residuals.begin(), residuals.end());
      const size_t n = residuals.size();
      const double middle = (residuals[(n - 1) / 2] + residuals[n / 2]) / 2;
      double sum_weight = 0;
      double sum_value = 0;
      for (Row& row : rows) {
        const double e = (residual(row) - middle) / scale;
        row.weight = 1 / ((1 + e * e) * (1 + e * e));
        sum_weight += row.weight;
        sum_value += row.weight * row.value;
      }
      // a_i is 1 at the gain and r^2 at the vignetting; eliminating the cell's colour leaves
      // sum w a a^T - (sum w a)(sum w a)^T / sum w.
      for (const Row& i : rows) {
        const Eigen::Vector2d a(1, i.radius_squared);
        right.segment<2>(2 * i.photo) += i.weight * (i.value - sum_value / sum_weight) * a;
        normal.block<2, 2>(2 * i.photo, 2 * i.photo) += i.weight * a * a.transpose();
        for (const Row& j : rows) {
          normal.block<2, 2>(2 * i.photo, 2 * j.photo) -=
              i.weight * j.weight / sum_weight * a * Eigen::RowVector2d(1, j.radius_squared);
        }
      }
    }
    // Weak priors: no gain and no vignetting where nothing speaks for them. They also anchor the
    // mean.
    const double prior = 1e-4 * static_cast<double>(overlaps.size()) + 1e-6;
    for (int photo = 0; photo < num_photos; ++photo) {
      normal(2 * photo, 2 * photo) += prior;
      normal(2 * photo + 1, 2 * photo + 1) += 10 * prior;
    }
    solution = normal.ldlt().solve(right);
  }
  for (int photo = 0; photo < num_photos; ++photo) {
    photos[photo].log_gain[channel] = static_cast<float>(solution[2 * photo]);
    photos[photo].vignetting[channel] = static_cast<float>(solution[2 * photo + 1]);
  }
}

// One round of face gains around the cells' weighted medians.
void SolveFaceGains(const std::vector<ChartCells>& cells, ColourModel& colour) {
  constexpr double kEvenLight = 0.06;  // log units: what counts as no difference
  constexpr double kFewCells = 12;     // below this many, a chart's gain is pulled to none
  for (size_t chart = 0; chart < cells.size(); ++chart) {
    const ChartCells& grid = cells[chart];
    std::vector<Eigen::Array3f> shift(grid.photos.size(), Eigen::Array3f::Zero());
    std::vector<std::pair<float, float>> sorted;
    std::vector<double> count(grid.photos.size(), 0);
    for (int channel = 0; channel < 3; ++channel) {
      std::vector<std::vector<std::pair<float, float>>> residuals(grid.photos.size());
      for (int cell = 0; cell < grid.NumCells(); ++cell) {
        const CellView* views = grid.ViewsOf(cell);
        sorted.clear();
        for (size_t k = 0; k < grid.photos.size(); ++k) {
          if (!views[k].is_usable) continue;
          const int photo = grid.photos[k];
          const double unevenness = colour.photos[photo].unevenness;
          const double weight = 1 / (kEvenLight * kEvenLight + unevenness * unevenness);
          sorted.emplace_back(
              colour.Corrected(
                  photo, static_cast<int>(chart), static_cast<int>(k), views[k])[channel],
              static_cast<float>(weight));
        }
        if (sorted.size() < 2) continue;
        const float reference = WeightedMedian(sorted);
        for (size_t k = 0; k < grid.photos.size(); ++k) {
          if (!views[k].is_usable) continue;
          const float value = colour.Corrected(
              grid.photos[k], static_cast<int>(chart), static_cast<int>(k), views[k])[channel];
          residuals[k].emplace_back(value - reference, 1.0f);
        }
      }
      for (size_t k = 0; k < grid.photos.size(); ++k) {
        count[k] = static_cast<double>(residuals[k].size());
        if (residuals[k].empty()) continue;
        shift[k][channel] =
            WeightedMedian(residuals[k]) * static_cast<float>(count[k] / (count[k] + kFewCells));
      }
    }
    for (size_t k = 0; k < grid.photos.size(); ++k) colour.face_gains[chart][k] += shift[k];
  }
  // How uneven each photograph's light is.
  std::vector<double> squares(colour.photos.size(), 0);
  std::vector<double> weights(colour.photos.size(), 1e-9);
  for (size_t chart = 0; chart < cells.size(); ++chart) {
    const double weight = std::sqrt(static_cast<double>(cells[chart].NumCells()));
    for (size_t k = 0; k < cells[chart].photos.size(); ++k) {
      const double gain = std::min(1.0, std::abs<double>(colour.face_gains[chart][k].mean()));
      squares[cells[chart].photos[k]] += weight * gain * gain;
      weights[cells[chart].photos[k]] += weight;
    }
  }
  for (size_t photo = 0; photo < colour.photos.size(); ++photo) {
    colour.photos[photo].unevenness = std::sqrt(squares[photo] / weights[photo]);
  }
}

}  // namespace

ColourModel MakeNeutralColour(const std::vector<ChartCells>& cells, size_t num_photos) {
  ColourModel colour;
  colour.photos.resize(num_photos);
  for (const ChartCells& chart : cells) {
    colour.face_gains.emplace_back(chart.photos.size(), Eigen::Array3f::Zero());
  }
  return colour;
}

ColourModel EstimateColour(const std::vector<ChartCells>& cells, size_t num_photos) {
  ColourModel colour = MakeNeutralColour(cells, num_photos);
  const std::vector<Overlap> overlaps = FindOverlaps(cells);
  if (overlaps.empty()) return colour;
  for (int channel = 0; channel < 3; ++channel) {
    SolveGains(cells, overlaps, channel, colour.photos);
  }
  for (int round = 0; round < 3; ++round) SolveFaceGains(cells, colour);
  return colour;
}

}  // namespace groundglass
