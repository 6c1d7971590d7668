// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/compose.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace groundglass {
namespace {

// A photograph's part in one texel.
struct Ingredient {
  int k = -1;
  double weight = 0;
  Sighting sighting;
};

// The four cells around a texel and their bilinear weights; the texel's own cell alone where seams
// are hard.
struct CellBlend {
  int cells[4];
  double weights[4];

  CellBlend(int x, int y, const ChartCells& grid, bool is_smooth) {
    if (!is_smooth) {
      std::fill_n(cells, 4, y / kCellTexels * grid.width + x / kCellTexels);
      std::fill_n(weights, 4, 0.25);
      return;
    }
    const double cx = std::clamp((x + 0.5) / kCellTexels - 0.5, 0.0, grid.width - 1.0);
    const double cy = std::clamp((y + 0.5) / kCellTexels - 0.5, 0.0, grid.height - 1.0);
    const int x0 = static_cast<int>(cx);
    const int y0 = static_cast<int>(cy);
    const int x1 = std::min(x0 + 1, grid.width - 1);
    const int y1 = std::min(y0 + 1, grid.height - 1);
    const double tx = cx - x0;
    const double ty = cy - y0;
    cells[0] = y0 * grid.width + x0;
    cells[1] = y0 * grid.width + x1;
    cells[2] = y1 * grid.width + x0;
    cells[3] = y1 * grid.width + x1;
    weights[0] = (1 - tx) * (1 - ty);
    weights[1] = tx * (1 - ty);
    weights[2] = (1 - tx) * ty;
    weights[3] = tx * ty;
  }
};

class Composer {
 public:
  Composer(const Chart& chart,
           int chart_index,
           const ChartTexels& texels,
           const std::vector<PreparedPhoto>& photos,
           const ChartCells& cells,
           const ChartChoice& choice,
           const ColourModel& colour,
           const BakeOptions& options)
      : chart_(chart),
        chart_index_(chart_index),
        texels_(texels),
        photos_(photos),
        cells_(cells),
        choice_(choice),
        colour_(colour),
        options_(options) {}

  // The photographs of one texel with weights that sum to 1; empty if none shows it.
  void Gather(int x, int y, std::vector<Ingredient>& ingredients) const {
    ingredients.clear();
    const Eigen::Vector3d point = chart_.PointInWorld(texels_.PointAt(x, y));
    const int face = texels_.FaceAt(x, y);
    const CellBlend blend(x, y, cells_, options_.smooth_seams);
    double chosen = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const int k = choice_.best[blend.cells[corner]];
      if (k < 0 || blend.weights[corner] <= 0) continue;
      Ingredient& ingredient = Find(k, point, face, ingredients);
      const double weight = blend.weights[corner] * BorderWeight(ingredient.sighting);
      ingredient.weight += weight;
      chosen += weight;
    }
    if (chosen < 0.5) {
      // Those chosen do not see enough of it: the others, the better the more.
      double best = 0;
      std::vector<double> quality(cells_.photos.size(), 0);
      for (size_t k = 0; k < cells_.photos.size(); ++k) {
        const Ingredient& ingredient = Find(static_cast<int>(k), point, face, ingredients);
        double acceptance = 0;
        for (int corner = 0; corner < 4; ++corner) {
          acceptance += blend.weights[corner] *
                        choice_.acceptance[blend.cells[corner] * cells_.photos.size() + k];
        }
        quality[k] = ingredient.sighting.quality * (acceptance + 1e-6);
        best = std::max(best, quality[k]);
      }
      if (best > 0) {
        for (Ingredient& ingredient : ingredients) {
          const double share = quality[ingredient.k] / best;
          ingredient.weight += (0.5 - chosen) * 1e-2 * share * share * share * share;
        }
      }
    }
    std::erase_if(ingredients, [](const Ingredient& i) { return i.weight <= 0; });
    double sum = 0;
    double largest = 0;
    for (const Ingredient& i : ingredients) largest = std::max(largest, i.weight);
    std::erase_if(ingredients, [&](const Ingredient& i) { return i.weight < 0.02 * largest; });
    for (const Ingredient& i : ingredients) sum += i.weight;
    for (Ingredient& i : ingredients) i.weight /= sum;
  }

  Eigen::Array3f Mix(const std::vector<Ingredient>& ingredients) const {
    Eigen::Array3f radiance = Eigen::Array3f::Zero();
    for (const Ingredient& i : ingredients) {
      const int photo = cells_.photos[i.k];
      const Eigen::Array3f sample = photos_[photo].Sample(i.sighting, chart_.texel_size, 4);
      radiance += static_cast<float>(i.weight) * sample *
                  colour_.Correction(
                      photo, chart_index_, i.k, photos_[photo].RadiusSquared(i.sighting.image_px));
    }
    return radiance;
  }

  bool IsGood(const std::vector<Ingredient>& ingredients) const {
    return std::any_of(ingredients.begin(), ingredients.end(), [&](const Ingredient& i) {
      return i.weight > 0.3 && i.sighting.border_px >= options_.border_margin_px;
    });
  }

  // How many texels lie between a border and the first clean pixel of this photograph.
  uint8_t ReachFromBorder(const Sighting& sighting) const {
    constexpr double kFarthest = 32;
    const double det = std::abs(sighting.px_from_unit.determinant());
    const double long_side = det > 0 ? sighting.px_from_unit.norm() / det : 0;  // unit for one px
    const double reach = 1 + (options_.border_margin_px + 1) * long_side / chart_.texel_size;
    return static_cast<uint8_t>(std::min(kFarthest, std::ceil(reach)));
  }

 private:
  // Quality 0 stands for "does not see it".
  Ingredient& Find(int k,
                   const Eigen::Vector3d& point,
                   int face,
                   std::vector<Ingredient>& ingredients) const {
    for (Ingredient& ingredient : ingredients) {
      if (ingredient.k == k) return ingredient;
    }
    Ingredient& ingredient = ingredients.emplace_back();
    ingredient.k = k;
    const auto sighting = photos_[cells_.photos[k]].Sight(point, chart_, chart_index_, face);
    if (sighting) ingredient.sighting = *sighting;
    return ingredient;
  }

  double BorderWeight(const Sighting& sighting) const {
    if (sighting.quality <= 0) return 0;
    const double t = (sighting.border_px - options_.border_margin_px + 0.5) / 2;
    return std::clamp(t, 1e-3, 1.0);
  }

  const Chart& chart_;
  int chart_index_;
  const ChartTexels& texels_;
  const std::vector<PreparedPhoto>& photos_;
  const ChartCells& cells_;
  const ChartChoice& choice_;
  const ColourModel& colour_;
  const BakeOptions& options_;
};

}  // namespace

ChartPixels ComposeChart(const Chart& chart,
                         int chart_index,
                         const ChartTexels& texels,
                         const std::vector<PreparedPhoto>& photos,
                         const ChartCells& cells,
                         const ChartChoice& choice,
                         const ColourModel& colour,
                         const BakeOptions& options) {
  constexpr int kFootprintStep = 4;
  const int width = chart.width_texels;
  const int height = chart.height_texels;
  ChartPixels pixels;
  pixels.srgb8 = Image8(width, height, 3);
  pixels.provenance = Image16(width, height, 1);
  pixels.states = Raster<uint8_t>(width, height, 1);
  pixels.reach = Raster<uint8_t>(width, height, 1);
  const Composer composer(chart, chart_index, texels, photos, cells, choice, colour, options);
  Raster<float> footprints((width + kFootprintStep - 1) / kFootprintStep,
                           (height + kFootprintStep - 1) / kFootprintStep,
                           1);
  tbb::parallel_for(0, height, [&](int y) {
    std::vector<Ingredient> ingredients;
    for (int x = 0; x < width; ++x) {
      if (texels.FaceAt(x, y) < 0) continue;
      composer.Gather(x, y, ingredients);
      TexelState state = TexelState::kOpen;
      if (!ingredients.empty()) {
        state = composer.IsGood(ingredients) ? TexelState::kGood : TexelState::kWeak;
        const Eigen::Array3f radiance = composer.Mix(ingredients);
        for (int c = 0; c < 3; ++c) pixels.srgb8.At(x, y)[c] = Srgb8FromRadiance(radiance[c]);
        const auto main = std::max_element(
            ingredients.begin(), ingredients.end(), [](const Ingredient& a, const Ingredient& b) {
              return a.weight < b.weight || (a.weight == b.weight && a.k > b.k);
            });
        if (state == TexelState::kWeak) {
          *pixels.reach.At(x, y) = composer.ReachFromBorder(main->sighting);
        }
        *pixels.provenance.At(x, y) = static_cast<uint16_t>(cells.photos[main->k] + 1);
        if (x % kFootprintStep == 0 && y % kFootprintStep == 0) {
          *footprints.At(x / kFootprintStep, y / kFootprintStep) = static_cast<float>(
              1 / std::sqrt(std::abs(main->sighting.px_from_unit.determinant())));
        }
      }
      *pixels.states.At(x, y) = static_cast<uint8_t>(state);
    }
  });

  std::map<std::pair<int, int>, FaceSource> sources;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int photo = *pixels.provenance.At(x, y) - 1;
      if (photo < 0 || !texels.IsCentreInside(x, y)) continue;
      FaceSource& source = sources[{texels.FaceAt(x, y), photo}];
      ++source.num_texels;
      if (x % kFootprintStep == 0 && y % kFootprintStep == 0) {
        source.footprints.push_back(*footprints.At(x / kFootprintStep, y / kFootprintStep));
      }
    }
  }
  for (auto& [key, source] : sources) {
    source.face = key.first;
    source.photo = key.second;
    pixels.sources.push_back(std::move(source));
  }
  return pixels;
}

}  // namespace groundglass
