// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/choose.h"

#include <algorithm>
#include <cmath>

namespace groundglass {
namespace {

// Differences of corrected colour (log units, mean over channels) that are ordinary: film grain,
// resolution, a pixel of misregistration.
constexpr float kOrdinaryDifference = 0.18f;

// Squared difference to the consensus in units of what is ordinary; -1 where there is no say.
// With three views or more the consensus is the view that most others agree with.
std::vector<float> MeasureDissent(const ChartCells& cells, int chart, const ColourModel& colour) {
  constexpr float kCap = 9;
  const size_t num_photos = cells.photos.size();
  std::vector<float> dissent(cells.views.size(), -1);
  std::vector<size_t> seen;
  std::vector<Eigen::Array3f> colours;
  for (int cell = 0; cell < cells.NumCells(); ++cell) {
    const CellView* views = cells.ViewsOf(cell);
    seen.clear();
    colours.clear();
    for (size_t k = 0; k < num_photos; ++k) {
      if (views[k].quality <= 0) continue;
      seen.push_back(k);
      colours.push_back(colour.Corrected(cells.photos[k], chart, static_cast<int>(k), views[k]));
    }
    if (seen.size() < 3) continue;
    const auto difference = [&](size_t i, size_t j) {
      const float squared = (colours[i] - colours[j]).square().mean();
      return std::min(kCap, squared / (kOrdinaryDifference * kOrdinaryDifference));
    };
    size_t middle = 0;
    double least = 1e300;
    for (size_t i = 0; i < seen.size(); ++i) {
      double cost = 0;
      for (size_t j = 0; j < seen.size(); ++j) {
        const double unevenness = colour.photos[cells.photos[seen[j]]].unevenness;
        cost += difference(i, j) / (0.1 + unevenness);
      }
      if (cost < least) {
        least = cost;
        middle = i;
      }
    }
    for (size_t i = 0; i < seen.size(); ++i) {
      dissent[cell * num_photos + seen[i]] = difference(i, middle);
    }
  }
  return dissent;
}

// Mean over the 3 x 3 neighbours that have a say: an occluder is larger than a cell.
std::vector<float> Smooth(const ChartCells& cells, const std::vector<float>& dissent) {
  const size_t num_photos = cells.photos.size();
  std::vector<float> smooth(dissent.size(), -1);
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      for (size_t k = 0; k < num_photos; ++k) {
        const size_t index = (static_cast<size_t>(y) * cells.width + x) * num_photos + k;
        if (dissent[index] < 0) continue;
        float sum = 0;
        int count = 0;
        for (int j = std::max(0, y - 1); j <= std::min(cells.height - 1, y + 1); ++j) {
          for (int i = std::max(0, x - 1); i <= std::min(cells.width - 1, x + 1); ++i) {
            const float value =
                dissent[(static_cast<size_t>(j) * cells.width + i) * num_photos + k];
            if (value < 0) continue;
            sum += value;
            ++count;
          }
        }
        smooth[index] = sum / static_cast<float>(count);
      }
    }
  }
  return smooth;
}

}  // namespace

ChartChoice ChooseCells(const ChartCells& cells,
                        int chart,
                        const ColourModel& colour,
                        const BakeOptions& options) {
  const size_t num_photos = cells.photos.size();
  ChartChoice choice;
  choice.best.assign(cells.NumCells(), -1);
  choice.acceptance.assign(cells.views.size(), 1);
  if (options.reject_occluders && num_photos >= 3) {
    const std::vector<float> dissent = Smooth(cells, MeasureDissent(cells, chart, colour));
    for (size_t i = 0; i < dissent.size(); ++i) {
      if (dissent[i] > 0) choice.acceptance[i] = std::exp(-dissent[i]);
    }
  }
  for (int cell = 0; cell < cells.NumCells(); ++cell) {
    const CellView* views = cells.ViewsOf(cell);
    float best = 0;
    for (size_t k = 0; k < num_photos; ++k) {
      const float score = views[k].quality * choice.acceptance[cell * num_photos + k];
      if (score > best) {
        best = score;
        choice.best[cell] = static_cast<int>(k);
      }
    }
  }
  return choice;
}

}  // namespace groundglass
