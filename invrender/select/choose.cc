// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/select/choose.h"

#include "invrender/select/colour_histogram.h"
#include "invrender/select/seams.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace groundglass {
namespace {

// Differences of corrected colour (log units, mean over channels) that are ordinary: film grain,
// resolution, a pixel of misregistration.
constexpr float kOrdinaryDifference = 0.22f;
// Squared differences beyond this many ordinary ones are all alike.
constexpr float kLargestDissent = 9;
// How much a colour that the wall does not have elsewhere counts against a view.
constexpr float kPaletteWeight = 0.5f;
// How much a view of lower quality loses, for each e-fold.
constexpr float kBlurWeight = 1;
// Sun and cast shadows: how fast photographs with uneven light lose.
constexpr double kEvenLightPreference = 2;

// Views that differ less than this from the consensus agree with it.
constexpr float kAgreeing = 1;
// Where less than this share of the votes agrees, there is no majority.
constexpr float kMajority = 0.34f;
// There, if three or more look, differing from the one in the middle says little, and the
// photograph that shows the place best is a good guess.
constexpr float kDisputedWeight = 0.25f;

// The colours of one block in the photographs that see it.
struct CellColours {
  std::vector<size_t> seen;  // k
  std::vector<Eigen::Array3f> colours;
  std::vector<float> votes;
  float best_quality = 0;

  void Set(const ChartBlocks& blocks, int block, int chart, const ColourModel& colour) {
    seen.clear();
    colours.clear();
    votes.clear();
    best_quality = 0;
    const CellView* views = blocks.ViewsOf(block);
    for (size_t k = 0; k < blocks.photos.size(); ++k) {
      if (views[k].quality <= 0) continue;
      const int photo = blocks.photos[k];
      seen.push_back(k);
      colours.push_back(colour.Corrected(photo, chart, static_cast<int>(k), views[k]));
      // A blurred view of a wall says little about what stands there.
      votes.push_back(views[k].quality /
                      static_cast<float>(0.1 + colour.photos[photo].nonuniformity));
      best_quality = std::max(best_quality, views[k].quality);
    }
  }
  float Difference(size_t i, size_t j) const {
    const float squared = (colours[i] - colours[j]).square().mean();
    return std::min(kLargestDissent, squared / (kOrdinaryDifference * kOrdinaryDifference));
  }
};

// What colours the chart has where photographs agree.
ColourHistogram LearnPalette(const ChartBlocks& blocks, int chart, const ColourModel& colour) {
  ColourHistogram palette;
  CellColours cell_colours;
  for (int block = 0; block < blocks.NumCells(); ++block) {
    cell_colours.Set(blocks, block, chart, colour);
    const size_t count = cell_colours.seen.size();
    for (size_t i = 0; i < count; ++i) {
      int num_agreeing = 0;
      for (size_t j = 0; j < count; ++j) {
        num_agreeing += j != i && cell_colours.Difference(i, j) <= 1 ? 1 : 0;
      }
      if (num_agreeing > 0) palette.Add(cell_colours.colours[i], num_agreeing);
    }
  }
  return palette;
}

// Mean over the neighbours within `reach` blocks that have a value (0 or more) for the same
// photograph; -1 stays -1. An occluder is larger than a block.
std::vector<float> Smooth(const ChartBlocks& blocks, const std::vector<float>& values, int reach) {
  const size_t num_photos = blocks.photos.size();
  const auto index = [&](int x, int y, size_t k) {
    return (static_cast<size_t>(y) * blocks.width + x) * num_photos + k;
  };
  // Rows, then columns: sums and counts.
  std::vector<std::array<float, 2>> rows(values.size(), {0, 0});
  for (int y = 0; y < blocks.height; ++y) {
    for (int x = 0; x < blocks.width; ++x) {
      for (int i = std::max(0, x - reach); i <= std::min(blocks.width - 1, x + reach); ++i) {
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
        for (int j = std::max(0, y - reach); j <= std::min(blocks.height - 1, y + reach); ++j) {
          sum += rows[index(x, j, k)][0];
          count += rows[index(x, j, k)][1];
        }
        smooth[index(x, y, k)] = sum / count;
      }
    }
  }
  return smooth;
}

// Where no majority agrees, as on glossy or recessed windows, block-by-block decisions would tear
// what stands there into patches. Each connected region of such blocks is judged as a whole: a
// view's inconsistency is its mean over the region, and what it does not show of it counts against
// it.
void VoteByRegion(const ChartBlocks& blocks,
                  const std::vector<float>& consensus,
                  std::vector<float>& inconsistency) {
  const size_t num_photos = blocks.photos.size();
  std::vector<char> is_open(blocks.NumCells(), 0);  // disputed, not yet in a region
  for (int block = 0; block < blocks.NumCells(); ++block) {
    float most = -1;
    for (size_t k = 0; k < num_photos; ++k)
      most = std::max(most, consensus[block * num_photos + k]);
    is_open[block] = most >= 0 && most < kMajority;
  }
  std::vector<int> region;
  for (int start = 0; start < blocks.NumCells(); ++start) {
    if (!is_open[start]) continue;
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
    long num_views = 0;
    for (const int block : region) {
      for (size_t k = 0; k < num_photos; ++k)
        num_views += inconsistency[block * num_photos + k] >= 0;
    }
    const float weight = num_views >= 3 * static_cast<long>(region.size()) ? kDisputedWeight : 1.0f;
    for (size_t k = 0; k < num_photos; ++k) {
      float sum = 0;
      for (const int block : region) {
        const float value = inconsistency[block * num_photos + k];
        sum += value < 0 ? kLargestDissent : value;
      }
      const float mean = weight * sum / static_cast<float>(region.size());
      for (const int block : region) {
        float& value = inconsistency[block * num_photos + k];
        if (value >= 0) value = mean;
      }
    }
  }
}

// Squared difference of each view to the consensus, in units of what is ordinary; -1 where nobody
// else sees the block. The consensus is the view that the others and the palette speak for, with
// the surroundings' say.
std::vector<float> MeasureDissent(const ChartBlocks& blocks, int chart, const ColourModel& colour) {
  const size_t num_photos = blocks.photos.size();
  ColourHistogram palette = LearnPalette(blocks, chart, colour);
  std::vector<float> cost(blocks.views.size(), -1);
  CellColours cell_colours;
  for (int block = 0; block < blocks.NumCells(); ++block) {
    cell_colours.Set(blocks, block, chart, colour);
    const size_t count = cell_colours.seen.size();
    if (count < 2) continue;
    for (size_t i = 0; i < count; ++i) {
      float sum = 0;
      float votes = 0;
      for (size_t j = 0; j < count; ++j) {
        if (j == i) continue;
        sum += cell_colours.votes[j] * cell_colours.Difference(i, j);
        votes += cell_colours.votes[j];
      }
      cost[block * num_photos + cell_colours.seen[i]] =
          sum / votes + kPaletteWeight * palette.NegativeLogLikelihood(cell_colours.colours[i]) +
          kBlurWeight * std::log(cell_colours.best_quality /
                                 blocks.ViewsOf(block)[cell_colours.seen[i]].quality);
    }
  }
  cost = Smooth(blocks, cost, 2);
  std::vector<float> inconsistency(blocks.views.size(), -1);
  std::vector<float> consensus(blocks.views.size(), -1);
  for (int block = 0; block < blocks.NumCells(); ++block) {
    cell_colours.Set(blocks, block, chart, colour);
    const size_t count = cell_colours.seen.size();
    if (count < 2) continue;
    const size_t* seen = cell_colours.seen.data();
    size_t middle = 0;
    for (size_t i = 1; i < count; ++i) {
      if (cost[block * num_photos + seen[i]] < cost[block * num_photos + seen[middle]]) middle = i;
    }
    float agreeing = 0;
    float all = 0;
    for (size_t i = 0; i < count; ++i) {
      const float difference = cell_colours.Difference(i, middle);
      inconsistency[block * num_photos + seen[i]] = difference;
      if (i == middle) continue;
      all += cell_colours.votes[i];
      if (difference < kAgreeing) agreeing += cell_colours.votes[i];
    }
    for (size_t i = 0; i < count; ++i) consensus[block * num_photos + seen[i]] = agreeing / all;
  }
  inconsistency = Smooth(blocks, inconsistency, 1);
  VoteByRegion(blocks, Smooth(blocks, consensus, 2), inconsistency);
  return inconsistency;
}

// Lowers the consistency of blurred photographs where three or more look: of two, one may show an
// occluder, and a blurred wall is better than a sharp van.
void PreferSharp(const ChartBlocks& blocks,
                 int block,
                 const std::vector<Sharpness>& sharpness,
                 float* consistency) {
  const size_t num_photos = blocks.photos.size();
  const CellView* views = blocks.ViewsOf(block);
  const auto num_seeing = std::count_if(
      views, views + num_photos, [](const CellView& view) { return view.quality > 0; });
  if (num_seeing < 3) return;
  for (size_t k = 0; k < num_photos; ++k) {
    consistency[k] *= static_cast<float>(sharpness[blocks.photos[k]].factor);
  }
}

}  // namespace

ChartChoice ChooseBlocks(const ChartBlocks& blocks,
                         int chart,
                         const ColourModel& colour,
                         const std::vector<Sharpness>& sharpness,
                         const BakeOptions& options) {
  const size_t num_photos = blocks.photos.size();
  ChartChoice choice;
  choice.best.assign(blocks.NumCells(), -1);
  choice.consistency.assign(blocks.views.size(), 1);
  if (options.reject_occluders && num_photos >= 2) {
    const std::vector<float> inconsistency = MeasureDissent(blocks, chart, colour);
    for (size_t i = 0; i < inconsistency.size(); ++i) {
      if (inconsistency[i] > 0) choice.consistency[i] = std::exp(-inconsistency[i]);
      choice.consistency[i] *= static_cast<float>(std::exp(
          -kEvenLightPreference * colour.photos[blocks.photos[i % num_photos]].nonuniformity));
    }
  }
  for (int block = 0; block < blocks.NumCells(); ++block) {
    const CellView* views = blocks.ViewsOf(block);
    if (!sharpness.empty())
      PreferSharp(blocks, block, sharpness, &choice.consistency[block * num_photos]);
    float best = 0;
    for (size_t k = 0; k < num_photos; ++k) {
      const float score = views[k].quality * choice.consistency[block * num_photos + k];
      if (score > best) {
        best = score;
        choice.best[block] = static_cast<int>(k);
      }
    }
  }
  if (options.smooth_seams) SmoothSeams(blocks, chart, colour, choice);
  return choice;
}

}  // namespace groundglass
