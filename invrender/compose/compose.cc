// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/compose/compose.h"

#include "invrender/compose/blender.h"
#include "invrender/photos/srgb_codes.h"

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

// Who shows each texel of a few rows, row by row and by photograph.
using BandLookups = std::vector<std::vector<Lookup>>;

// A chart's texels on the way.
class ChartComposer {
 public:
  ChartComposer(const ComposeInputs& inputs,
                const ColourModel& colour,
                const BlendOptions& options,
                int bits)
      : inputs_(inputs),
        width_(inputs.chart.width_texels),
        height_(inputs.chart.height_texels),
        sampling_(options.sampling),
        blender_(inputs, options),
        footprints_((width_ + kFootprintStep - 1) / kFootprintStep,
                    (height_ + kFootprintStep - 1) / kFootprintStep,
                    1) {
    const std::vector<int>& photos = inputs.blocks.photos;
    for (size_t k = 0; k < photos.size(); ++k) {
      corrections_.emplace_back(colour, photos[k], inputs.chart_index, static_cast<int>(k));
    }
    if (bits == 16) {
      pixels_.srgb16 = Image16(width_, height_, 3);
    } else {
      pixels_.srgb8 = Image8(width_, height_, 3);
    }
    pixels_.provenance = Image16(width_, height_, 1);
    pixels_.states = Raster<uint8_t>(width_, height_, 1);
    pixels_.reach = Raster<uint8_t>(width_, height_, 1);
  }

  // First who shows each texel of some rows and where, then, photograph by photograph, what.
  void ComposeBand(int y0, int num_rows) {
    BandLookups lookups(num_rows);
    tbb::parallel_for(0, num_rows, [&](int row) { FindRow(y0 + row, lookups[row]); });
    const ImageF radiance = SampleBand(lookups);
    tbb::parallel_for(0, num_rows, [&](int row) { Encode(radiance.At(0, row), y0 + row); });
  }

  // When all bands are done.
  ChartPixels Finish() {
    CollectSources();
    return std::move(pixels_);
  }

 private:
  // The look-ups of a row's texels; their states, provenance and reach.
  void FindRow(int y, std::vector<Lookup>& lookups) {
    std::vector<Contribution> contributions;
    std::array<SurfaceObservation, Blender::kRunTexels> run;
    std::vector<int> chosen;
    blender_.ChooseRow(y, chosen);
    for (int x = 0; x < width_;) {
      if (inputs_.texels.FaceAt(x, y) < 0) {
        ++x;
        continue;
      }
      const int num_in_run = blender_.GatherRun(x, y, chosen, run);
      contributions.resize(1);
      contributions[0] = {chosen[x], 1, true, {}};
      for (int i = 0; i < num_in_run; ++i, ++x) {
        contributions[0].observation = run[i];
        AddTexel(x, y, contributions, lookups);
      }
      if (num_in_run > 0) continue;
      if (contributions[0].k < 0 ||
          !blender_.SeesClear(contributions[0].k, x, y, contributions[0].observation)) {
        blender_.Gather(x, y, contributions);
      }
      *pixels_.states.At(x, y) = static_cast<uint8_t>(TexelState::kOpen);
      if (!contributions.empty()) AddTexel(x, y, contributions, lookups);
      ++x;
    }
    SortByPhoto(inputs_.blocks.photos.size(), lookups);
  }

  void AddTexel(int x,
                int y,
                const std::vector<Contribution>& contributions,
                std::vector<Lookup>& lookups) {
    const Contribution& main =
        *std::max_element(contributions.begin(),
                          contributions.end(),
                          [](const Contribution& a, const Contribution& b) {
                            return a.weight < b.weight || (a.weight == b.weight && a.k > b.k);
                          });
    for (const Contribution& i : contributions) {
      lookups.push_back({i.k,
                         x,
                         static_cast<float>(i.weight),
                         i.observation.image_px.cast<float>(),
                         i.observation.px_from_unit.cast<float>()});
    }
    const bool is_good = blender_.IsGood(contributions);
    *pixels_.states.At(x, y) =
        static_cast<uint8_t>(is_good ? TexelState::kGood : TexelState::kWeak);
    if (!is_good) *pixels_.reach.At(x, y) = blender_.ReachFromBorder(main.observation);
    *pixels_.provenance.At(x, y) = static_cast<uint16_t>(inputs_.blocks.photos[main.k] + 1);
    if (x % kFootprintStep == 0 && y % kFootprintStep == 0) {
      *footprints_.At(x / kFootprintStep, y / kFootprintStep) =
          static_cast<float>(1 / std::sqrt(std::abs(main.observation.px_from_unit.determinant())));
    }
  }

  // What is seen there, photograph by photograph, so that each is decoded once.
  ImageF SampleBand(const BandLookups& lookups) const {
    const std::vector<int>& photos = inputs_.blocks.photos;
    std::vector<char> is_used(photos.size(), 0);
    for (const std::vector<Lookup>& row : lookups) {
      for (const Lookup& lookup : row) is_used[lookup.k] = 1;
    }
    const int num_rows = static_cast<int>(lookups.size());
    ImageF radiance(width_, num_rows, 3);
    std::vector<size_t> next(num_rows, 0);  // in lookups
    for (int k = 0; k < static_cast<int>(photos.size()); ++k) {
      if (!is_used[k]) continue;
      const PreparedPhoto& photo = inputs_.photos[photos[k]];
      const std::shared_ptr<const PhotoPyramid> pyramid = photo.Pixels();
      tbb::parallel_for(0, num_rows, [&](int row) {
        for (; next[row] < lookups[row].size() && lookups[row][next[row]].k == k; ++next[row]) {
          const Lookup& lookup = lookups[row][next[row]];
          const Eigen::Vector2d image_px = lookup.image_px.cast<double>();
          Eigen::Map<Eigen::Array3f>(radiance.At(lookup.x, row)) +=
              lookup.weight *
              pyramid->Sample(image_px,
                              lookup.px_from_unit.cast<double>() * inputs_.chart.texel_size,
                              sampling_) *
              corrections_[k].At(photo.RadiusSquared(image_px));
        }
      });
    }
    return radiance;
  }

  void Encode(const float* radiance, int y) {
    if (!pixels_.srgb16.Empty()) {
      std::transform(radiance, radiance + 3 * width_, pixels_.srgb16.At(0, y), Srgb16FromRadiance);
    } else {
      Srgb8FromRadiance({radiance, static_cast<size_t>(3 * width_)}, pixels_.srgb8.At(0, y));
    }
  }

  void CollectSources() {
    std::map<std::pair<int, int>, FaceSource> sources;
    FaceSource* last = nullptr;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const int photo = *pixels_.provenance.At(x, y) - 1;
        if (photo < 0 || !inputs_.texels.IsCentreInside(x, y)) continue;
        const int face = inputs_.texels.FaceAt(x, y);
        if (!last || last->face != face || last->photo != photo) {
          last = &sources[{face, photo}];
          last->face = face;
          last->photo = photo;
        }
        ++last->num_texels;
        if (x % kFootprintStep == 0 && y % kFootprintStep == 0) {
          last->footprints.push_back(*footprints_.At(x / kFootprintStep, y / kFootprintStep));
        }
      }
    }
    for (auto& [key, source] : sources) pixels_.sources.push_back(std::move(source));
  }

  // Of every so manieth texel each way the footprint is kept.
  static constexpr int kFootprintStep = 4;

  const ComposeInputs& inputs_;
  int width_;
  int height_;
  const SamplingOptions& sampling_;
  Blender blender_;
  std::vector<CorrectionTable> corrections_;  // by k
  ChartPixels pixels_;
  Raster<float> footprints_;
};

}  // namespace

ChartPixels ComposeChart(const ComposeInputs& inputs,
                         const ColourModel& colour,
                         const BlendOptions& options,
                         int bits) {
  ChartComposer composer(inputs, colour, options, bits);
  const int height = inputs.chart.height_texels;
  const int band_rows = std::max(16, kBandTexels / inputs.chart.width_texels);
  for (int y0 = 0; y0 < height; y0 += band_rows) {
    composer.ComposeBand(y0, std::min(height - y0, band_rows));
  }
  return composer.Finish();
}

}  // namespace groundglass
