// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/select/choose.h"

#include "invrender/select/colour_histogram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace groundglass {
namespace {

// The colours of one block in the photographs that see it.
struct BlockColours {
  const ConsistencyOptions& options;
  std::vector<size_t> seen;  // k
  std::vector<Eigen::Array3f> colours;
  std::vector<float> votes;
  float best_quality = 0;

  explicit BlockColours(const ConsistencyOptions& consistency_options)
      : options(consistency_options) {}
  void Set(const ChartBlocks& blocks, int block, int chart, const ColourModel& colour) {
    seen.clear();
    colours.clear();
    votes.clear();
    best_quality = 0;
    const BlockView* views = blocks.ViewsOf(block);
    for (size_t k = 0; k < blocks.photos.size(); ++k) {
      if (views[k].quality <= 0) continue;
      const int photo = blocks.photos[k];
      seen.push_back(k);
      colours.push_back(colour.Corrected(photo, chart, static_cast<int>(k), views[k]));
      // A blurred view of a wall says little about what stands there.
      votes.push_back(views[k].quality / static_cast<float>(options.vote_unevenness +
                                                            colour.photos[photo].nonuniformity));
      best_quality = std::max(best_quality, views[k].quality);
    }
  }
  float Difference(size_t i, size_t j) const {
    const float squared = (colours[i] - colours[j]).square().mean();
    return std::min(options.max_inconsistency,
                    squared / (options.ordinary_difference * options.ordinary_difference));
  }
};

// What colours the chart has where photographs agree.
ColourHistogram LearnColours(const ChartBlocks& blocks,
                             int chart,
                             const ColourModel& colour,
                             const ConsistencyOptions& options) {
  ColourHistogram histogram(options.histogram);
  BlockColours block_colours(options);
  for (int block = 0; block < blocks.NumBlocks(); ++block) {
    block_colours.Set(blocks, block, chart, colour);
    const size_t count = block_colours.seen.size();
    for (size_t i = 0; i < count; ++i) {
      int num_agreeing = 0;
      for (size_t j = 0; j < count; ++j) {
        num_agreeing += j != i && block_colours.Difference(i, j) <= options.agreeing ? 1 : 0;
      }
      if (num_agreeing > 0) histogram.Add(block_colours.colours[i], num_agreeing);
    }
  }
  return histogram;
}

// Mean over the neighbours within `radius` blocks that have a value (0 or more) for the same
// photograph; -1 stays -1. (Not cv::boxFilter: it keeps running sums, whose last bits differ.)
std::vector<float> Smooth(const ChartBlocks& blocks, const std::vector<float>& values, int radius) {
  const size_t num_photos = blocks.photos.size();
  const auto index = [&](int x, int y, size_t k) {
    return (static_cast<size_t>(y) * blocks.width + x) * num_photos + k;
  };
  // Rows, then columns: sums and counts.
  std::vector<std::array<float, 2>> rows(values.size(), {0, 0});
  for (int y = 0; y < blocks.height; ++y) {
    for (int x = 0; x < blocks.width; ++x) {
      for (int i = std::max(0, x - radius); i <= std::min(blocks.width - 1, x + radius); ++i) {
        for (size_t k = 0; k < num_photos; ++k) {
          const float value = values[index(i, y, k)];
          if (value < 0) continue;
          rows[index(x, y, k)][0] += value;
          rows[index(x, y, k)][1] += 1;
        }
      }
    }
  }
  std::vector<float> smooth(values.size(), -1);
  for (int y = 0; y < blocks.height; ++y) {
    for (int x = 0; x < blocks.width; ++x) {
      for (size_t k = 0; k < num_photos; ++k) {
        if (values[index(x, y, k)] < 0) continue;
        float sum = 0;
        float count = 0;
        for (int j = std::max(0, y - radius); j <= std::min(blocks.height - 1, y + radius); ++j) {
          sum += rows[index(x, j, k)][0];
          count += rows[index(x, j, k)][1];
        }
        smooth[index(x, y, k)] = sum / count;
      }
    }
  }
  return smooth;
}

// Blocks that are connected, corners too, starting with `start`; they are no longer open.
void TakeRegion(const ChartBlocks& blocks,
                int start,
                std::vector<char>& is_open,
                std::vector<int>& region) {
  region.assign(1, start);
  is_open[start] = 0;
  for (size_t next = 0; next < region.size(); ++next) {
    const int x = region[next] % blocks.width;
    const int y = region[next] / blocks.width;
    for (int j = std::max(0, y - 1); j <= std::min(blocks.height - 1, y + 1); ++j) {
      for (int i = std::max(0, x - 1); i <= std::min(blocks.width - 1, x + 1); ++i) {
        const int neighbour = j * blocks.width + i;
        if (!is_open[neighbour]) continue;
        is_open[neighbour] = 0;
        region.push_back(neighbour);
      }
    }
  }
}

// Where no majority agrees, as on glossy or recessed windows, block-by-block decisions would tear
// what stands there into patches. Each connected region of such blocks is judged as a whole: a
// view's inconsistency is its mean over the region, and what it does not show of it counts against
// it. (Regions are grown here, not by cv::connectedComponents: sums of floats keep the order in
// which blocks are reached, and so the results their last bits.)
void VoteByRegion(const ChartBlocks& blocks,
                  const std::vector<float>& consensus,
                  const ConsistencyOptions& options,
                  std::vector<float>& inconsistency) {
  const size_t num_photos = blocks.photos.size();
  std::vector<char> is_open(blocks.NumBlocks(), 0);  // disputed, not yet in a region
  for (int block = 0; block < blocks.NumBlocks(); ++block) {
    float most = -1;
    for (size_t k = 0; k < num_photos; ++k)
      most = std::max(most, consensus[block * num_photos + k]);
    is_open[block] = most >= 0 && most < options.majority;
  }
  std::vector<int> region;
  for (int start = 0; start < blocks.NumBlocks(); ++start) {
    if (!is_open[start]) continue;
    TakeRegion(blocks, start, is_open, region);
    long num_views = 0;
    for (const int block : region) {
      for (size_t k = 0; k < num_photos; ++k)
        num_views += inconsistency[block * num_photos + k] >= 0;
    }
    const bool are_many = num_views >= options.fewest_to_compare * static_cast<long>(region.size());
    const float weight = are_many ? options.disputed_weight : 1.0f;
    for (size_t k = 0; k < num_photos; ++k) {
      float sum = 0;
      for (const int block : region) {
        const float value = inconsistency[block * num_photos + k];
        sum += value < 0 ? options.max_inconsistency : value;
      }
      const float mean = weight * sum / static_cast<float>(region.size());
      for (const int block : region) {
        float& value = inconsistency[block * num_photos + k];
        if (value >= 0) value = mean;
      }
    }
  }
}

// How little the others and the histogram speak for each view of a block, with the surroundings'
// say; -1 where nobody else sees the block.
std::vector<float> MeasureCost(const ChartBlocks& blocks,
                               int chart,
                               const ColourModel& colour,
                               const ConsistencyOptions& options) {
  const size_t num_photos = blocks.photos.size();
  ColourHistogram histogram = LearnColours(blocks, chart, colour, options);
  std::vector<float> cost(blocks.views.size(), -1);
  BlockColours block_colours(options);
  for (int block = 0; block < blocks.NumBlocks(); ++block) {
    block_colours.Set(blocks, block, chart, colour);
    const size_t count = block_colours.seen.size();
    if (count < 2) continue;
    for (size_t i = 0; i < count; ++i) {
      float sum = 0;
      float votes = 0;
      for (size_t j = 0; j < count; ++j) {
        if (j == i) continue;
        sum += block_colours.votes[j] * block_colours.Difference(i, j);
        votes += block_colours.votes[j];
      }
      cost[block * num_photos + block_colours.seen[i]] =
          sum / votes +
          options.histogram_weight * histogram.NegativeLogLikelihood(block_colours.colours[i]) +
          options.blur_weight * std::log(block_colours.best_quality /
                                         blocks.ViewsOf(block)[block_colours.seen[i]].quality);
    }
  }
  return Smooth(blocks, cost, options.cost_radius);
}

// Squared difference of each view to the consensus, in units of what is ordinary; -1 where nobody
// else sees the block. The consensus is the view that costs least.
std::vector<float> MeasureInconsistency(const ChartBlocks& blocks,
                                        int chart,
                                        const ColourModel& colour,
                                        const ConsistencyOptions& options) {
  const size_t num_photos = blocks.photos.size();
  const std::vector<float> cost = MeasureCost(blocks, chart, colour, options);
  BlockColours block_colours(options);
  std::vector<float> inconsistency(blocks.views.size(), -1);
  std::vector<float> consensus(blocks.views.size(), -1);
  for (int block = 0; block < blocks.NumBlocks(); ++block) {
    block_colours.Set(blocks, block, chart, colour);
    const size_t count = block_colours.seen.size();
    if (count < 2) continue;
    const size_t* seen = block_colours.seen.data();
    size_t middle = 0;
    for (size_t i = 1; i < count; ++i) {
      if (cost[block * num_photos + seen[i]] < cost[block * num_photos + seen[middle]]) middle = i;
    }
    float agreeing = 0;
    float all = 0;
    for (size_t i = 0; i < count; ++i) {
      const float difference = block_colours.Difference(i, middle);
      inconsistency[block * num_photos + seen[i]] = difference;
      if (i == middle) continue;
      all += block_colours.votes[i];
      if (difference < options.agreeing) agreeing += block_colours.votes[i];
    }
    for (size_t i = 0; i < count; ++i) consensus[block * num_photos + seen[i]] = agreeing / all;
  }
  inconsistency = Smooth(blocks, inconsistency, options.inconsistency_radius);
  VoteByRegion(blocks, Smooth(blocks, consensus, options.consensus_radius), options, inconsistency);
  return inconsistency;
}

}  // namespace

std::vector<float> MeasureConsistency(const ChartBlocks& blocks,
                                      int chart,
                                      const ColourModel& colour,
                                      const ConsistencyOptions& options) {
  const size_t num_photos = blocks.photos.size();
  std::vector<float> consistency(blocks.views.size(), 1);
  if (num_photos < 2) return consistency;
  const std::vector<float> inconsistency = MeasureInconsistency(blocks, chart, colour, options);
  for (size_t i = 0; i < inconsistency.size(); ++i) {
    if (inconsistency[i] > 0) consistency[i] = std::exp(-inconsistency[i]);
    consistency[i] *=
        static_cast<float>(std::exp(-options.even_light_preference *
                                    colour.photos[blocks.photos[i % num_photos]].nonuniformity));
  }
  return consistency;
}

void PreferSharp(const ChartBlocks& blocks,
                 const std::vector<Sharpness>& sharpness,
                 const ConsistencyOptions& options,
                 std::vector<float>& consistency) {
  const size_t num_photos = blocks.photos.size();
  for (int block = 0; block < blocks.NumBlocks(); ++block) {
    const BlockView* views = blocks.ViewsOf(block);
    const auto num_seeing = std::count_if(
        views, views + num_photos, [](const BlockView& view) { return view.quality > 0; });
    if (num_seeing < options.fewest_to_compare) continue;
    for (size_t k = 0; k < num_photos; ++k) {
      consistency[block * num_photos + k] *= static_cast<float>(sharpness[blocks.photos[k]].factor);
    }
  }
}

ChartChoice ChooseBlocks(const ChartBlocks& blocks, std::vector<float> consistency) {
  const size_t num_photos = blocks.photos.size();
  ChartChoice choice;
  choice.best.assign(blocks.NumBlocks(), -1);
  choice.consistency = std::move(consistency);
  for (int block = 0; block < blocks.NumBlocks(); ++block) {
    const BlockView* views = blocks.ViewsOf(block);
    float best = 0;
    for (size_t k = 0; k < num_photos; ++k) {
      const float score = views[k].quality * choice.consistency[block * num_photos + k];
      if (score > best) {
        best = score;
        choice.best[block] = static_cast<int>(k);
      }
    }
  }
  return choice;
}

}  // namespace groundglass
