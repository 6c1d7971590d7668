// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/choose.h"

#include "invrender/palette.h"
#include "invrender/seams.h"

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

// The colours of one cell in the photographs that see it.
struct CellColours {
  std::vector<size_t> seen;  // k
  std::vector<Eigen::Array3f> colours;
  std::vector<float> votes;
  float best_quality = 0;

  void Set(const ChartCells& cells, int cell, int chart, const ColourModel& colour) {
    seen.clear();
    colours.clear();
    votes.clear();
    best_quality = 0;
    const CellView* views = cells.ViewsOf(cell);
    for (size_t k = 0; k < cells.photos.size(); ++k) {
      if (views[k].quality <= 0) continue;
      const int photo = cells.photos[k];
      seen.push_back(k);
      colours.push_back(colour.Corrected(photo, chart, static_cast<int>(k), views[k]));
      // A blurred view of a wall says little about what stands there.
      votes.push_back(views[k].quality / static_cast<float>(0.1 + colour.photos[photo].unevenness));
      best_quality = std::max(best_quality, views[k].quality);
    }
  }
  float Difference(size_t i, size_t j) const {
    const float squared = (colours[i] - colours[j]).square().mean();
    return std::min(kLargestDissent, squared / (kOrdinaryDifference * kOrdinaryDifference));
  }
};

// What colours the chart has where photographs agree.
Palette LearnPalette(const ChartCells& cells, int chart, const ColourModel& colour) {
  Palette palette;
  CellColours cell_colours;
  for (int cell = 0; cell < cells.NumCells(); ++cell) {
    cell_colours.Set(cells, cell, chart, colour);
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

// Mean over the neighbours within `reach` cells that have a value (0 or more) for the same
// photograph; -1 stays -1. An occluder is larger than a cell.
std::vector<float> Smooth(const ChartCells& cells, const std::vector<float>& values, int reach) {
  const size_t num_photos = cells.photos.size();
  const auto index = [&](int x, int y, size_t k) {
    return (static_cast<size_t>(y) * cells.width + x) * num_photos + k;
  };
  // Rows, then columns: sums and counts.
  std::vector<std::array<float, 2>> rows(values.size(), {0, 0});
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      for (int i = std::max(0, x - reach); i <= std::min(cells.width - 1, x + reach); ++i) {
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
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      for (size_t k = 0; k < num_photos; ++k) {
        if (values[index(x, y, k)] < 0) continue;
        float sum = 0;
        float count = 0;
        for (int j = std::max(0, y - reach); j <= std::min(cells.height - 1, y + reach); ++j) {
          sum += rows[index(x, j, k)][0];
          count += rows[index(x, j, k)][1];
        }
        smooth[index(x, y, k)] = sum / count;
      }
    }
  }
  return smooth;
}

// Where no majority agrees, as on glossy or recessed windows, cell-by-cell decisions would tear
// what stands there into patches. Each connected region of such cells is judged as a whole: a
// view's dissent is its mean over the region, and what it does not show of it counts against it.
void SettleDisputes(const ChartCells& cells,
                    const std::vector<float>& support,
                    std::vector<float>& dissent) {
  const size_t num_photos = cells.photos.size();
  std::vector<char> is_open(cells.NumCells(), 0);  // disputed, not yet in a region
  for (int cell = 0; cell < cells.NumCells(); ++cell) {
    float most = -1;
    for (size_t k = 0; k < num_photos; ++k) most = std::max(most, support[cell * num_photos + k]);
    is_open[cell] = most >= 0 && most < kMajority;
  }
  std::vector<int> region;
  for (int start = 0; start < cells.NumCells(); ++start) {
    if (!is_open[start]) continue;
    region.assign(1, start);
    is_open[start] = 0;
    for (size_t next = 0; next < region.size(); ++next) {
      const int x = region[next] % cells.width;
      const int y = region[next] / cells.width;
      for (int j = std::max(0, y - 1); j <= std::min(cells.height - 1, y + 1); ++j) {
        for (int i = std::max(0, x - 1); i <= std::min(cells.width - 1, x + 1); ++i) {
          const int neighbour = j * cells.width + i;
          if (!is_open[neighbour]) continue;
          is_open[neighbour] = 0;
          region.push_back(neighbour);
        }
      }
    }
    long num_views = 0;
    for (const int cell : region) {
      for (size_t k = 0; k < num_photos; ++k) num_views += dissent[cell * num_photos + k] >= 0;
    }
    const float weight = num_views >= 3 * static_cast<long>(region.size()) ? kDisputedWeight : 1.0f;
    for (size_t k = 0; k < num_photos; ++k) {
      float sum = 0;
      for (const int cell : region) {
        const float value = dissent[cell * num_photos + k];
        sum += value < 0 ? kLargestDissent : value;
      }
      const float mean = weight * sum / static_cast<float>(region.size());
      for (const int cell : region) {
        float& value = dissent[cell * num_photos + k];
        if (value >= 0) value = mean;
      }
    }
  }
}

// Squared difference of each view to the consensus, in units of what is ordinary; -1 where nobody
// else sees the cell. The consensus is the view that the others and the palette speak for, with
// the surroundings' say.
std::vector<float> MeasureDissent(const ChartCells& cells, int chart, const ColourModel& colour) {
  const size_t num_photos = cells.photos.size();
  Palette palette = LearnPalette(cells, chart, colour);
  std::vector<float> cost(cells.views.size(), -1);
  CellColours cell_colours;
  for (int cell = 0; cell < cells.NumCells(); ++cell) {
    cell_colours.Set(cells, cell, chart, colour);
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
      cost[cell * num_photos + cell_colours.seen[i]] =
          sum / votes + kPaletteWeight * palette.Surprise(cell_colours.colours[i]) +
          kBlurWeight * std::log(cell_colours.best_quality /
                                 cells.ViewsOf(cell)[cell_colours.seen[i]].quality);
    }
  }
  cost = Smooth(cells, cost, 2);
  std::vector<float> dissent(cells.views.size(), -1);
  std::vector<float> support(cells.views.size(), -1);
  for (int cell = 0; cell < cells.NumCells(); ++cell) {
    cell_colours.Set(cells, cell, chart, colour);
    const size_t count = cell_colours.seen.size();
    if (count < 2) continue;
    const size_t* seen = cell_colours.seen.data();
    size_t middle = 0;
    for (size_t i = 1; i < count; ++i) {
      if (cost[cell * num_photos + seen[i]] < cost[cell * num_photos + seen[middle]]) middle = i;
    }
    float agreeing = 0;
    float all = 0;
    for (size_t i = 0; i < count; ++i) {
      const float difference = cell_colours.Difference(i, middle);
      dissent[cell * num_photos + seen[i]] = difference;
      if (i == middle) continue;
      all += cell_colours.votes[i];
      if (difference < kAgreeing) agreeing += cell_colours.votes[i];
    }
    for (size_t i = 0; i < count; ++i) support[cell * num_photos + seen[i]] = agreeing / all;
  }
  dissent = Smooth(cells, dissent, 1);
  SettleDisputes(cells, Smooth(cells, support, 2), dissent);
  return dissent;
}

// Lowers the acceptance of blurred photographs where three or more look: of two, one may show an
// occluder, and a blurred wall is better than a sharp van.
void PreferSharp(const ChartCells& cells,
                 int cell,
                 const std::vector<Sharpness>& sharpness,
                 float* acceptance) {
  const size_t num_photos = cells.photos.size();
  const CellView* views = cells.ViewsOf(cell);
  const auto num_seeing = std::count_if(
      views, views + num_photos, [](const CellView& view) { return view.quality > 0; });
  if (num_seeing < 3) return;
  for (size_t k = 0; k < num_photos; ++k) {
    acceptance[k] *= static_cast<float>(sharpness[cells.photos[k]].factor);
  }
}

}  // namespace

ChartChoice ChooseCells(const ChartCells& cells,
                        int chart,
                        const ColourModel& colour,
                        const std::vector<Sharpness>& sharpness,
                        const BakeOptions& options) {
  const size_t num_photos = cells.photos.size();
  ChartChoice choice;
  choice.best.assign(cells.NumCells(), -1);
  choice.acceptance.assign(cells.views.size(), 1);
  if (options.reject_occluders && num_photos >= 2) {
    const std::vector<float> dissent = MeasureDissent(cells, chart, colour);
    for (size_t i = 0; i < dissent.size(); ++i) {
      if (dissent[i] > 0) choice.acceptance[i] = std::exp(-dissent[i]);
      choice.acceptance[i] *= static_cast<float>(
          std::exp(-kEvenLightPreference * colour.photos[cells.photos[i % num_photos]].unevenness));
    }
  }
  for (int cell = 0; cell < cells.NumCells(); ++cell) {
    const CellView* views = cells.ViewsOf(cell);
    if (!sharpness.empty())
      PreferSharp(cells, cell, sharpness, &choice.acceptance[cell * num_photos]);
    float best = 0;
    for (size_t k = 0; k < num_photos; ++k) {
      const float score = views[k].quality * choice.acceptance[cell * num_photos + k];
      if (score > best) {
        best = score;
        choice.best[cell] = static_cast<int>(k);
      }
    }
  }
  if (options.smooth_seams) SmoothSeams(cells, chart, colour, choice);
  return choice;
}

}  // namespace groundglass
