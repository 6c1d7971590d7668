// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/compose/compose.h"

#include "invrender/compose/blender.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

namespace groundglass {
namespace {

// What radiance is multiplied by, as a table over the squared distance from the image's centre.
class CorrectionTable {
 public:
  CorrectionTable(const ColourModel& colour, int photo, int chart, int k) {
    for (int i = 0; i <= kSteps + 1; ++i) {
      values_[i] = colour.Correction(photo, chart, k, static_cast<double>(i) / kSteps);
    }
  }
  Eigen::Array3f At(double radius_squared) const {
    const auto position = static_cast<float>(std::clamp(radius_squared, 0.0, 1.0) * kSteps);
    const int index = static_cast<int>(position);
    const float t = position - static_cast<float>(index);
    return (1 - t) * values_[index] + t * values_[index + 1];
  }

 private:
  static constexpr int kSteps = 64;
  std::array<Eigen::Array3f, kSteps + 2> values_;
};

// One look-up for a texel of a row.
struct Lookup {
  int k = 0;
  int x = 0;
  float weight = 0;
  Eigen::Vector2f image_px;
  Eigen::Matrix2f px_from_unit;
};

// In the order that they have for each photograph.
void SortByPhoto(size_t num_photos, std::vector<Lookup>& lookups) {
  std::vector<size_t> next(num_photos + 1, 0);
  for (const Lookup& lookup : lookups) ++next[lookup.k + 1];
  if (std::count(next.begin(), next.end(), lookups.size()) == 1) return;  // all of one
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Lookup> sorted(lookups.size());
  for (const Lookup& lookup : lookups) sorted[next[lookup.k]++] = lookup;
  lookups = std::move(sorted);
}

constexpr int kFootprintStep = 4;  // of every fourth texel each way the footprint is kept

}  // namespace

ChartPixels ComposeChart(const Chart& chart,
                         int chart_index,
                         const ChartTexels& texels,
                         const std::vector<PreparedPhoto>& photos,
                         const ChartBlocks& blocks,
                         const ChartChoice& choice,
                         const ColourModel& colour,
                         const BakeOptions& options) {
  const int width = chart.width_texels;
  const int height = chart.height_texels;
  ChartPixels pixels;
  if (options.bits == 16) {
    pixels.srgb16 = Image16(width, height, 3);
  } else {
    pixels.srgb8 = Image8(width, height, 3);
  }
  pixels.provenance = Image16(width, height, 1);
  pixels.states = Raster<uint8_t>(width, height, 1);
  pixels.reach = Raster<uint8_t>(width, height, 1);
  const Blender mixer(chart, chart_index, texels, photos, blocks, choice, options);
  std::vector<CorrectionTable> corrections;
  for (size_t k = 0; k < blocks.photos.size(); ++k) {
    corrections.emplace_back(colour, blocks.photos[k], chart_index, static_cast<int>(k));
  }
  Raster<float> footprints((width + kFootprintStep - 1) / kFootprintStep,
                           (height + kFootprintStep - 1) / kFootprintStep,
                           1);
  // Band by band: first who shows each texel and where, then, photograph by photograph, what.
  const int band_rows = std::max(16, kBandTexels / width);
  for (int y0 = 0; y0 < height; y0 += band_rows) {
    const int num_rows = std::min(height - y0, band_rows);
    std::vector<std::vector<Lookup>> lookups(num_rows);  // by photograph
    tbb::parallel_for(0, num_rows, [&](int row) {
      std::vector<Contribution> ingredients;
      std::array<SurfaceObservation, Blender::kRunTexels> run;
      std::vector<int> chosen;
      const int y = y0 + row;
      mixer.ChooseRow(y, chosen);
      const auto add = [&](int x) {
        const Contribution& main =
            *std::max_element(ingredients.begin(),
                              ingredients.end(),
                              [](const Contribution& a, const Contribution& b) {
                                return a.weight < b.weight || (a.weight == b.weight && a.k > b.k);
                              });
        for (const Contribution& i : ingredients) {
          lookups[row].push_back({i.k,
                                  x,
                                  static_cast<float>(i.weight),
                                  i.sighting.image_px.cast<float>(),
                                  i.sighting.px_from_unit.cast<float>()});
        }
        const bool is_good = mixer.IsGood(ingredients);
        *pixels.states.At(x, y) =
            static_cast<uint8_t>(is_good ? TexelState::kGood : TexelState::kWeak);
        if (!is_good) *pixels.reach.At(x, y) = mixer.ReachFromBorder(main.sighting);
        *pixels.provenance.At(x, y) = static_cast<uint16_t>(blocks.photos[main.k] + 1);
        if (x % kFootprintStep == 0 && y % kFootprintStep == 0) {
          *footprints.At(x / kFootprintStep, y / kFootprintStep) =
              static_cast<float>(1 / std::sqrt(std::abs(main.sighting.px_from_unit.determinant())));
        }
      };
      for (int x = 0; x < width;) {
        if (texels.FaceAt(x, y) < 0) {
          ++x;
          continue;
        }
        const int num_in_run = mixer.GatherRun(x, y, chosen, run);
        ingredients.resize(1);
        ingredients[0] = {chosen[x], 1, true, {}};
        for (int i = 0; i < num_in_run; ++i, ++x) {
          ingredients[0].sighting = run[i];
          add(x);
        }
        if (num_in_run > 0) continue;
        if (ingredients[0].k < 0 ||
            !mixer.SeesClear(ingredients[0].k, x, y, ingredients[0].sighting)) {
          mixer.Gather(x, y, ingredients);
        }
        *pixels.states.At(x, y) = static_cast<uint8_t>(TexelState::kOpen);
        if (!ingredients.empty()) add(x);
        ++x;
      }
      SortByPhoto(blocks.photos.size(), lookups[row]);
    });
    std::vector<char> is_used(blocks.photos.size(), 0);
    for (const std::vector<Lookup>& row : lookups) {
      for (const Lookup& lookup : row) is_used[lookup.k] = 1;
    }
    ImageF radiance(width, num_rows, 3);
    std::vector<size_t> next(num_rows, 0);  // in lookups
    for (int k = 0; k < static_cast<int>(blocks.photos.size()); ++k) {
      if (!is_used[k]) continue;
      const PreparedPhoto& photo = photos[blocks.photos[k]];
      const std::shared_ptr<const PhotoPyramid> pyramid = photo.Pixels();
      tbb::parallel_for(0, num_rows, [&](int row) {
        for (; next[row] < lookups[row].size() && lookups[row][next[row]].k == k; ++next[row]) {
          const Lookup& lookup = lookups[row][next[row]];
          const Eigen::Vector2d image_px = lookup.image_px.cast<double>();
          Eigen::Map<Eigen::Array3f>(radiance.At(lookup.x, row)) +=
              lookup.weight *
              pyramid->Sample(image_px, lookup.px_from_unit.cast<double>() * chart.texel_size, 4) *
              corrections[k].At(photo.RadiusSquared(image_px));
        }
      });
    }
    tbb::parallel_for(0, num_rows, [&](int row) {
      const float* from = radiance.At(0, row);
      if (options.bits == 16) {
        std::transform(from, from + 3 * width, pixels.srgb16.At(0, y0 + row), Srgb16FromRadiance);
      } else {
        Srgb8FromRadiance({from, static_cast<size_t>(3 * width)}, pixels.srgb8.At(0, y0 + row));
      }
    });
  }

  std::map<std::pair<int, int>, FaceSource> sources;
  FaceSource* last = nullptr;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int photo = *pixels.provenance.At(x, y) - 1;
      if (photo < 0 || !texels.IsCentreInside(x, y)) continue;
      const int face = texels.FaceAt(x, y);
      if (!last || last->face != face || last->photo != photo) {
        last = &sources[{face, photo}];
        last->face = face;
        last->photo = photo;
      }
      ++last->num_texels;
      if (x % kFootprintStep == 0 && y % kFootprintStep == 0) {
        last->footprints.push_back(*footprints.At(x / kFootprintStep, y / kFootprintStep));
      }
    }
  }
  for (auto& [key, source] : sources) pixels.sources.push_back(std::move(source));
  return pixels;
}

}  // namespace groundglass
