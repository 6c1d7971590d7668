// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/colour/colour.h"

#include "invrender/measure/median.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Every how manieth block to look at, so that about `enough` are, and not always the same columns.
int StepThrough(const ChartBlocks& blocks, int enough) {
  const int step = std::max(1, blocks.NumBlocks() / enough);
  return step > 1 && blocks.width % step == 0 ? step + 1 : step;
}

// The blocks of one chart that two photographs both show.
struct Pair {
  const ChartBlocks* chart = nullptr;
  uint32_t first_k = 0;  // in chart->photos
  uint32_t second_k = 0;
  int first = 0;  // photographs
  int second = 0;
  std::vector<uint32_t> blocks;
  Eigen::Array3f difference = Eigen::Array3f::Zero();  // median of log radiance, first - second

  // The two views of one of the blocks.
  std::pair<const BlockView*, const BlockView*> Views(size_t i) const {
    const BlockView* views = chart->ViewsOf(static_cast<int>(blocks[i]));
    return {views + first_k, views + second_k};
  }
};

// Calls work(block, k of the photographs that show it well) for the blocks of a chart that pairs
// are sought in.
template <typename Work>
void ForEachUsable(const ChartBlocks& chart, const ColourOptions& options, const Work& work) {
  if (chart.NumBlocks() < options.fewest_shared) return;
  std::vector<size_t> usable;
  for (int block = 0; block < chart.NumBlocks();
       block += StepThrough(chart, options.enough_for_pairs)) {
    const BlockView* views = chart.ViewsOf(block);
    usable.clear();
    for (size_t k = 0; k < chart.photos.size(); ++k) {
      if (views[k].is_usable) usable.push_back(k);
    }
    work(block, usable);
  }
}

std::vector<Pair> FindPairs(const std::vector<ChartBlocks>& blocks, const ColourOptions& options) {
  // Of too many pairs every so manieth.
  size_t num_shared = 0;
  for (const ChartBlocks& chart : blocks) {
    ForEachUsable(chart, options, [&](int, const std::vector<size_t>& usable) {
      num_shared += usable.size() * (usable.size() - 1) / 2;
    });
  }
  const size_t stride = 1 + num_shared / static_cast<size_t>(options.most_shared);
  std::vector<Pair> pairs;
  for (const ChartBlocks& chart : blocks) {
    if (chart.NumBlocks() < options.fewest_shared) continue;
    const size_t num_photos = chart.photos.size();
    const auto is_wanted = [&](size_t a, size_t b) {
      return b == a + 1 || (a * 7919 + b * 104729) % stride == 0;
    };
    std::vector<std::vector<uint32_t>> shared(num_photos * num_photos);  // blocks
    ForEachUsable(chart, options, [&](int block, const std::vector<size_t>& usable) {
      for (size_t i = 0; i < usable.size(); ++i) {
        for (size_t j = i + 1; j < usable.size(); ++j) {
          if (!is_wanted(usable[i], usable[j])) continue;
          shared[usable[i] * num_photos + usable[j]].push_back(static_cast<uint32_t>(block));
        }
      }
    });
    for (size_t a = 0; a < num_photos; ++a) {
      for (size_t b = a + 1; b < num_photos; ++b) {
        std::vector<uint32_t>& both = shared[a * num_photos + b];
        if (static_cast<int>(both.size()) < options.fewest_shared) continue;
        Pair& pair = pairs.emplace_back();
        pair.chart = &chart;
        pair.first_k = static_cast<uint32_t>(a);
        pair.second_k = static_cast<uint32_t>(b);
        pair.first = chart.photos[a];
        pair.second = chart.photos[b];
        const size_t count = std::min(both.size(), static_cast<size_t>(options.enough_of_pair));
        pair.blocks.reserve(count);
        for (size_t i = 0; i < count; ++i) pair.blocks.push_back(both[i * both.size() / count]);
      }
    }
  }
  return pairs;
}

// Vignetting from how differences change ACROSS a chart, so that neither exposure nor the light on
// the chart as a whole matters.
void SolveVignetting(const std::vector<Pair>& pairs,
                     int channel,
                     const ColourOptions& options,
                     std::vector<ColourModel::Photo>& photos) {
  const Eigen::Index num_photos = static_cast<Eigen::Index>(photos.size());
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(num_photos);
  for (int round = 0; round < options.vignetting_rounds; ++round) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(num_photos, num_photos);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(num_photos);
    std::vector<float> residuals;
    std::vector<float> ordered;
    for (const Pair& pair : pairs) {
      const auto value = [&](size_t i) {
        const auto [a, b] = pair.Views(i);
        return a->log_radiance[channel] - b->log_radiance[channel];
      };
      const auto residual = [&](size_t i) {
        const auto [a, b] = pair.Views(i);
        return static_cast<float>(value(i) - solution[pair.first] * a->radius_squared +
                                  solution[pair.second] * b->radius_squared);
      };
      residuals.clear();
      for (size_t i = 0; i < pair.blocks.size(); ++i) residuals.push_back(residual(i));
      ordered = residuals;
      const float middle = Median(ordered);
      // Weighted means, to eliminate the chart's own difference.
      double sum_weight = 0;
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
      for (size_t i = 0; i < pair.blocks.size(); ++i) {
        const double e = (residuals[i] - middle) / options.vignetting_scale;
        const double weight = 1 / ((1 + e * e) * (1 + e * e));
        const auto [first, second] = pair.Views(i);
        const Eigen::Vector3d row(first->radius_squared, -second->radius_squared, value(i));
        sum_weight += weight;
        mean += weight * row;
        scatter += weight * row * row.transpose();
      }
      if (sum_weight < 1) continue;
      scatter -= mean * mean.transpose() / sum_weight;
      const int index[2] = {pair.first, pair.second};
      for (int i = 0; i < 2; ++i) {
        right[index[i]] += scatter(i, 2);
        for (int j = 0; j < 2; ++j) normal(index[i], index[j]) += scatter(i, j);
      }
    }
    // Lenses darken corners by some tenths; photographs of one set do so alike.
    const double prior = options.vignetting_prior;
    const double common = num_photos > 0 ? solution.mean() : 0;
    for (Eigen::Index photo = 0; photo < num_photos; ++photo) {
      normal(photo, photo) += prior;
      right[photo] += prior * common;
    }
    solution = normal.ldlt().solve(right);
  }
  for (Eigen::Index photo = 0; photo < num_photos; ++photo) {
    photos[photo].vignetting[channel] = static_cast<float>(solution[photo]);
  }
}

// One gain for each photograph. A chart gives one difference for each pair that shows it, however
// large it is: sun makes whole walls brighter. Differences on which the charts agree win.
void SolveGains(std::vector<Pair>& pairs,
                int channel,
                const ColourOptions& options,
                std::vector<ColourModel::Photo>& photos) {
  const Eigen::Index num_photos = static_cast<Eigen::Index>(photos.size());
  std::vector<float> differences;
  for (Pair& pair : pairs) {
    differences.clear();
    for (size_t i = 0; i < pair.blocks.size(); ++i) {
      const auto [a, b] = pair.Views(i);
      differences.push_back(a->log_radiance[channel] - b->log_radiance[channel] -
                            photos[pair.first].vignetting[channel] * a->radius_squared +
                            photos[pair.second].vignetting[channel] * b->radius_squared);
    }
    pair.difference[channel] = Median(differences);
  }
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(num_photos);
  for (const double scale : options.gain_scales) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(num_photos, num_photos);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(num_photos);
    for (const Pair& pair : pairs) {
      const double value = pair.difference[channel];
      const double e = (value - solution[pair.first] + solution[pair.second]) / scale;
      const double count = static_cast<double>(pair.blocks.size());
      const double weight = count / (count + options.many_blocks) / (1 + e * e);
      normal(pair.first, pair.first) += weight;
      normal(pair.second, pair.second) += weight;
      normal(pair.first, pair.second) -= weight;
      normal(pair.second, pair.first) -= weight;
      right[pair.first] += weight * value;
      right[pair.second] -= weight * value;
    }
    // A weak prior anchors the mean, and photographs that share nothing.
    for (Eigen::Index photo = 0; photo < num_photos; ++photo)
      normal(photo, photo) += options.gain_prior;
    solution = normal.ldlt().solve(right);
  }
  for (Eigen::Index photo = 0; photo < num_photos; ++photo) {
    photos[photo].log_gain[channel] = static_cast<float>(solution[photo]);
  }
}

// One round of face gains around the blocks' weighted medians.
void SolveFaceGains(const std::vector<ChartBlocks>& blocks,
                    const ColourOptions& options,
                    ColourModel& colour) {
  tbb::parallel_for(size_t{0}, blocks.size(), [&](size_t chart) {
    const ChartBlocks& grid = blocks[chart];
    std::vector<Eigen::Array3f> shift(grid.photos.size(), Eigen::Array3f::Zero());
    std::vector<std::pair<float, float>> sorted;
    std::vector<double> count(grid.photos.size(), 0);
    const int step = StepThrough(grid, options.enough_for_light);
    for (int channel = 0; channel < 3; ++channel) {
      std::vector<std::vector<float>> residuals(grid.photos.size());
      for (int block = 0; block < grid.NumBlocks(); block += step) {
        const BlockView* views = grid.ViewsOf(block);
        sorted.clear();
        for (size_t k = 0; k < grid.photos.size(); ++k) {
          if (!views[k].is_usable) continue;
          const int photo = grid.photos[k];
          const double nonuniformity = colour.photos[photo].nonuniformity;
          const double weight =
              1 / (options.even_light * options.even_light + nonuniformity * nonuniformity);
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
          residuals[k].push_back(value - reference);
        }
      }
      for (size_t k = 0; k < grid.photos.size(); ++k) {
        count[k] = static_cast<double>(residuals[k].size());
        if (residuals[k].empty()) continue;
        shift[k][channel] = LowerMedian(residuals[k]) *
                            static_cast<float>(count[k] / (count[k] + options.few_blocks));
      }
    }
    for (size_t k = 0; k < grid.photos.size(); ++k) colour.face_gains[chart][k] += shift[k];
  });
}

// How uneven each photograph's light is.
void JudgeUnevenness(const std::vector<ChartBlocks>& blocks,
                     const ColourOptions& options,
                     ColourModel& colour) {
  std::vector<double> squares(colour.photos.size(), 0);
  std::vector<double> weights(colour.photos.size(), 1e-9);
  for (size_t chart = 0; chart < blocks.size(); ++chart) {
    const double weight = std::sqrt(static_cast<double>(blocks[chart].NumBlocks()));
    for (size_t k = 0; k < blocks[chart].photos.size(); ++k) {
      const double gain =
          std::min(options.most_uneven, std::abs<double>(colour.face_gains[chart][k].mean()));
      squares[blocks[chart].photos[k]] += weight * gain * gain;
      weights[blocks[chart].photos[k]] += weight;
    }
  }
  for (size_t photo = 0; photo < colour.photos.size(); ++photo) {
    colour.photos[photo].nonuniformity = std::sqrt(squares[photo] / weights[photo]);
  }
}

// The picture as a whole keeps the mean exposure of the photographs whose light is even.
void AnchorOnMean(const ColourOptions& options, ColourModel& colour) {
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  float sum_weight = 0;
  for (const ColourModel::Photo& photo : colour.photos) {
    const double nonuniformity = photo.nonuniformity;
    const auto weight = static_cast<float>(
        1 / (options.even_light * options.even_light + nonuniformity * nonuniformity));
    // Vignetting darkens the outer parts only: what counts is the frame's middle.
    sum += weight * photo.log_gain;
    sum_weight += weight;
  }
  for (ColourModel::Photo& photo : colour.photos) photo.log_gain -= sum / sum_weight;
}

}  // namespace

ColourModel MakeNeutralColour(const std::vector<ChartBlocks>& blocks, size_t num_photos) {
  ColourModel colour;
  colour.photos.resize(num_photos);
  for (const ChartBlocks& chart : blocks) {
    colour.face_gains.emplace_back(chart.photos.size(), Eigen::Array3f::Zero());
  }
  return colour;
}

ColourModel EstimateColour(const std::vector<ChartBlocks>& blocks,
                           size_t num_photos,
                           const ColourOptions& options) {
  ColourModel colour = MakeNeutralColour(blocks, num_photos);
  std::vector<Pair> pairs = FindPairs(blocks, options);
  if (pairs.empty()) return colour;
  tbb::parallel_for(0, 3, [&](int channel) {
    SolveVignetting(pairs, channel, options, colour.photos);
    SolveGains(pairs, channel, options, colour.photos);
  });
  for (int round = 0; round < options.light_rounds; ++round) {
    SolveFaceGains(blocks, options, colour);
    JudgeUnevenness(blocks, options, colour);
  }
  AnchorOnMean(options, colour);
  return colour;
}

}  // namespace groundglass
