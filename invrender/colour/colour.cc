// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/colour/colour.h"

#include "scene/quantile.h"
#include "scene/weighted_quantile.h"

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
  // Log radiance, first - second.
  float DifferenceAt(size_t i, int channel) const {
    const auto [a, b] = Views(i);
    return a->log_radiance[channel] - b->log_radiance[channel];
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

// Every how manieth pair of photographs is looked at, so that no more blocks of pairs than
// most_shared are.
size_t StrideOfPairs(const std::vector<ChartBlocks>& blocks, const ColourOptions& options) {
  size_t num_shared = 0;
  for (const ChartBlocks& chart : blocks) {
    ForEachUsable(chart, options, [&](int, const std::vector<size_t>& usable) {
      num_shared += usable.size() * (usable.size() - 1) / 2;
    });
  }
  return 1 + num_shared / static_cast<size_t>(options.most_shared);
}

// [a * photos + b]: the blocks of a chart that its photographs a < b both show well.
std::vector<std::vector<uint32_t>> FindShared(const ChartBlocks& chart,
                                              size_t stride,
                                              const ColourOptions& options) {
  const size_t num_photos = chart.photos.size();
  // Neighbours always, and others as two primes scatter them.
  const auto is_wanted = [&](size_t a, size_t b) {
    return b == a + 1 || (a * 7919 + b * 104729) % stride == 0;
  };
  std::vector<std::vector<uint32_t>> shared(num_photos * num_photos);
  ForEachUsable(chart, options, [&](int block, const std::vector<size_t>& usable) {
    for (size_t i = 0; i < usable.size(); ++i) {
      for (size_t j = i + 1; j < usable.size(); ++j) {
        if (!is_wanted(usable[i], usable[j])) continue;
        shared[usable[i] * num_photos + usable[j]].push_back(static_cast<uint32_t>(block));
      }
    }
  });
  return shared;
}

// The pair of a chart's photographs a and b, with some of the blocks that they share.
Pair MakePair(const ChartBlocks& chart,
              size_t a,
              size_t b,
              const std::vector<uint32_t>& shared,
              const ColourOptions& options) {
  Pair pair;
  pair.chart = &chart;
  pair.first_k = static_cast<uint32_t>(a);
  pair.second_k = static_cast<uint32_t>(b);
  pair.first = chart.photos[a];
  pair.second = chart.photos[b];
  const size_t count = std::min(shared.size(), static_cast<size_t>(options.enough_of_pair));
  pair.blocks.reserve(count);
  for (size_t i = 0; i < count; ++i) pair.blocks.push_back(shared[i * shared.size() / count]);
  return pair;
}

std::vector<Pair> FindPairs(const std::vector<ChartBlocks>& blocks, const ColourOptions& options) {
  const size_t stride = StrideOfPairs(blocks, options);
  std::vector<Pair> pairs;
  for (const ChartBlocks& chart : blocks) {
    if (chart.NumBlocks() < options.fewest_shared) continue;
    const size_t num_photos = chart.photos.size();
    const std::vector<std::vector<uint32_t>> shared = FindShared(chart, stride, options);
    for (size_t a = 0; a < num_photos; ++a) {
      for (size_t b = a + 1; b < num_photos; ++b) {
        const std::vector<uint32_t>& both = shared[a * num_photos + b];
        if (static_cast<int>(both.size()) < options.fewest_shared) continue;
        pairs.push_back(MakePair(chart, a, b, both, options));
      }
    }
  }
  return pairs;
}

// Normal equations, one unknown for each photograph.
struct NormalEquations {
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;

  explicit NormalEquations(Eigen::Index num_photos)
      : normal(Eigen::MatrixXd::Zero(num_photos, num_photos)),
        right(Eigen::VectorXd::Zero(num_photos)) {}

  // Pulls each unknown to `mean`.
  void AddPrior(double weight, double mean) {
    normal.diagonal().array() += weight;
    right.array() += weight * mean;
  }
  Eigen::VectorXd Solve() const { return normal.ldlt().solve(right); }
};

// How strongly each block of a pair speaks for its vignetting: what is left of the difference by
// the vignetting so far, less its median, is weighed as under Student's t.
std::vector<double> WeighBlocks(const Pair& pair,
                                int channel,
                                const Eigen::VectorXd& vignetting,
                                double scale) {
  std::vector<float> residuals;
  for (size_t i = 0; i < pair.blocks.size(); ++i) {
    const auto [a, b] = pair.Views(i);
    residuals.push_back(static_cast<float>(pair.DifferenceAt(i, channel) -
                                           vignetting[pair.first] * a->radius_squared +
                                           vignetting[pair.second] * b->radius_squared));
  }
  const float middle = UpperMedian(residuals);
  std::vector<double> weights;
  for (const float residual : residuals) {
    const double e = (residual - middle) / scale;
    weights.push_back(1 / ((1 + e * e) * (1 + e * e)));
  }
  return weights;
}

// What one pair says of the vignetting of its two photographs. Means are taken off, so that neither
// exposure nor the light on the chart as a whole matters.
void AddVignetting(const Pair& pair,
                   int channel,
                   const std::vector<double>& weights,
                   NormalEquations& equations) {
  double sum_weight = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < pair.blocks.size(); ++i) {
    const auto [first, second] = pair.Views(i);
    const Eigen::Vector3d row(
        first->radius_squared, -second->radius_squared, pair.DifferenceAt(i, channel));
    sum_weight += weights[i];
    mean += weights[i] * row;
    scatter += weights[i] * row * row.transpose();
  }
  if (sum_weight < 1) return;
  scatter -= mean * mean.transpose() / sum_weight;
  const int index[2] = {pair.first, pair.second};
  for (int i = 0; i < 2; ++i) {
    equations.right[index[i]] += scatter(i, 2);
    for (int j = 0; j < 2; ++j) equations.normal(index[i], index[j]) += scatter(i, j);
  }
}

// Vignetting from how differences change ACROSS a chart, by iteratively reweighted least squares.
void SolveVignetting(const std::vector<Pair>& pairs,
                     int channel,
                     const ColourOptions& options,
                     std::vector<ColourModel::Photo>& photos) {
  const auto num_photos = static_cast<Eigen::Index>(photos.size());
  Eigen::VectorXd vignetting = Eigen::VectorXd::Zero(num_photos);
  for (int round = 0; round < options.vignetting_rounds; ++round) {
    NormalEquations equations(num_photos);
    for (const Pair& pair : pairs) {
      const std::vector<double> weights =
          WeighBlocks(pair, channel, vignetting, options.vignetting_scale);
      AddVignetting(pair, channel, weights, equations);
    }
    // Lenses darken corners by some tenths; photographs of one set do so alike.
    equations.AddPrior(options.vignetting_prior, num_photos > 0 ? vignetting.mean() : 0);
    vignetting = equations.Solve();
  }
  for (Eigen::Index photo = 0; photo < num_photos; ++photo) {
    photos[photo].vignetting[channel] = static_cast<float>(vignetting[photo]);
  }
}

// What a pair differs by in the median over its blocks, without vignetting.
float MedianDifference(const Pair& pair,
                       int channel,
                       const std::vector<ColourModel::Photo>& photos) {
  std::vector<float> differences;
  for (size_t i = 0; i < pair.blocks.size(); ++i) {
    const auto [a, b] = pair.Views(i);
    differences.push_back(pair.DifferenceAt(i, channel) -
                          photos[pair.first].vignetting[channel] * a->radius_squared +
                          photos[pair.second].vignetting[channel] * b->radius_squared);
  }
  return UpperMedian(std::move(differences));
}

// One gain for each photograph. A chart gives one difference for each pair that shows it, however
// large it is: sun makes whole walls brighter. Differences on which the charts agree win.
void SolveGains(std::vector<Pair>& pairs,
                int channel,
                const ColourOptions& options,
                std::vector<ColourModel::Photo>& photos) {
  const auto num_photos = static_cast<Eigen::Index>(photos.size());
  for (Pair& pair : pairs) pair.difference[channel] = MedianDifference(pair, channel, photos);
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(num_photos);
  for (const double scale : options.gain_scales) {
    NormalEquations equations(num_photos);
    for (const Pair& pair : pairs) {
      const double value = pair.difference[channel];
      const double e = (value - gains[pair.first] + gains[pair.second]) / scale;
      const double count = static_cast<double>(pair.blocks.size());
      const double weight = count / (count + options.many_blocks) / (1 + e * e);
      equations.normal(pair.first, pair.first) += weight;
      equations.normal(pair.second, pair.second) += weight;
      equations.normal(pair.first, pair.second) -= weight;
      equations.normal(pair.second, pair.first) -= weight;
      equations.right[pair.first] += weight * value;
      equations.right[pair.second] -= weight * value;
    }
    // A weak prior anchors the mean, and photographs that share nothing.
    equations.AddPrior(options.gain_prior, 0);
    gains = equations.Solve();
  }
  for (Eigen::Index photo = 0; photo < num_photos; ++photo) {
    photos[photo].log_gain[channel] = static_cast<float>(gains[photo]);
  }
}

// How much a photograph says of a wall's own colour: the more, the more even its light.
double EvennessWeight(const ColourModel::Photo& photo, const ColourOptions& options) {
  const double nonuniformity = photo.nonuniformity;
  return 1 / (options.even_light * options.even_light + nonuniformity * nonuniformity);
}

// [k]: by how much each photograph is brighter, in one channel, than the blocks' weighted medians.
std::vector<std::vector<float>> FindFaceResiduals(const ChartBlocks& grid,
                                                  int chart,
                                                  int channel,
                                                  const ColourOptions& options,
                                                  const ColourModel& colour) {
  std::vector<std::vector<float>> residuals(grid.photos.size());
  std::vector<WeightedValue<float>> values;
  std::vector<size_t> usable;
  const int step = StepThrough(grid, options.enough_for_light);
  for (int block = 0; block < grid.NumBlocks(); block += step) {
    const BlockView* views = grid.ViewsOf(block);
    const auto value = [&](size_t k) {
      return colour.Corrected(grid.photos[k], chart, static_cast<int>(k), views[k])[channel];
    };
    usable.clear();
    values.clear();
    for (size_t k = 0; k < grid.photos.size(); ++k) {
      if (!views[k].is_usable) continue;
      usable.push_back(k);
      const double weight = EvennessWeight(colour.photos[grid.photos[k]], options);
      values.push_back({value(k), static_cast<float>(weight)});
    }
    if (usable.size() < 2) continue;
    const float reference = WeightedMedian(values, 0.0f);
    for (const size_t k : usable) residuals[k].push_back(value(k) - reference);
  }
  return residuals;
}

// One round of face gains around the blocks' weighted medians.
void SolveFaceGains(const std::vector<ChartBlocks>& blocks,
                    const ColourOptions& options,
                    ColourModel& colour) {
  tbb::parallel_for(size_t{0}, blocks.size(), [&](size_t chart) {
    std::vector<Eigen::Array3f> shift(blocks[chart].photos.size(), Eigen::Array3f::Zero());
    for (int channel = 0; channel < 3; ++channel) {
      std::vector<std::vector<float>> residuals =
          FindFaceResiduals(blocks[chart], static_cast<int>(chart), channel, options, colour);
      for (size_t k = 0; k < residuals.size(); ++k) {
        if (residuals[k].empty()) continue;
        const auto count = static_cast<double>(residuals[k].size());
        const size_t lower_middle = (residuals[k].size() - 1) / 2;
        shift[k][channel] = ValueOfRank(std::move(residuals[k]), lower_middle) *
                            static_cast<float>(count / (count + options.few_blocks));
      }
    }
    for (size_t k = 0; k < shift.size(); ++k) colour.face_gains[chart][k] += shift[k];
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
    const auto weight = static_cast<float>(EvennessWeight(photo, options));
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
