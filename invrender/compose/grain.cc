// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/compose/grain.h"

#include "invrender/measure/bounded_least_squares.h"
#include "invrender/photos/srgb_codes.h"
#include "scene/quantile.h"

#include <opencv2/imgproc.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace groundglass {
namespace {

using Plane = cv::Mat_<float>;

// Smoothed by the binomial (1 4 6 4 1) / 16 over samples `step` apart, both ways.
Plane Smoothed(const Plane& in, int step) {
  cv::Mat_<float> taps = cv::Mat_<float>::zeros(4 * step + 1, 1);
  constexpr std::array<float, 5> kBinomial = {1, 4, 6, 4, 1};
  for (int i = 0; i < 5; ++i) taps(i * step) = kBinomial[i] / 16;
  Plane out;
  cv::sepFilter2D(in, out, CV_32F, taps, taps, {-1, -1}, 0, cv::BORDER_REPLICATE);
  return out;
}

// bands[0] + bands[1] + what is left in `coarse` is what was split.
struct Bands {
  std::array<Plane, kGrainBands> bands;
  Plane coarse;
};

Bands SplitBands(const Plane& in) {
  Bands split{{}, in};
  for (int b = 0; b < kGrainBands; ++b) {
    const Plane smooth = Smoothed(split.coarse, 1 << b);
    split.bands[b] = split.coarse - smooth;
    split.coarse = smooth;
  }
  return split;
}

// What the filters' reach leaves of a patch.
constexpr int kReach = 6;
constexpr int kInner = kPatchSide - 2 * kReach;
using BandPatch = Eigen::Array<float, kInner, kInner>;

struct PatchBands {
  int photo = -1;
  float mean = 0;  // encoded, 1 is white
  std::array<BandPatch, kGrainBands> bands;
  BandPatch Both() const { return bands[0] + bands[1]; }
};

PatchBands SplitPatch(const PatchView& view) {
  Plane luma(kPatchSide, kPatchSide);
  PatchBands patch;
  patch.photo = view.photo;
  for (int y = 0; y < kPatchSide; ++y) {
    for (int x = 0; x < kPatchSide; ++x) luma(y, x) = view.luma(y, x) / 65535.0f;
  }
  patch.mean = view.luma.cast<float>().mean() / 65535.0f;
  const Bands split = SplitBands(luma);
  for (int b = 0; b < kGrainBands; ++b) {
    for (int y = 0; y < kInner; ++y) {
      for (int x = 0; x < kInner; ++x) {
        patch.bands[b](y, x) = split.bands[b](y + kReach, x + kReach);
      }
    }
  }
  return patch;
}

using PhotoPair = std::pair<int, int>;  // ascending

// Two photographs' views of one patch.
struct PatchPair {
  const PatchBands* first = nullptr;
  const PatchBands* second = nullptr;
  float energy = 0;

  PatchPair(const PatchBands& a, const PatchBands& b)
      : first(a.photo < b.photo ? &a : &b),
        second(a.photo < b.photo ? &b : &a),
        energy(std::sqrt(a.Both().square().mean() * b.Both().square().mean())) {}
  PhotoPair Photos() const { return {first->photo, second->photo}; }
};

// Sums of correlations.
struct Agreement {
  double sum = 0;
  double count = 0;
};

// How alike two photographs each show the calmest of a chart's patches.
Agreement MeasureAgreement(std::vector<PatchPair> pairs, const GrainOptions& options) {
  constexpr int kShift = 3;
  constexpr int kNumShifts = 2 * kShift + 1;
  constexpr int kInside = kInner - 2 * kShift;
  using Correlations = Eigen::Array<double, kNumShifts, kNumShifts>;
  std::stable_sort(pairs.begin(), pairs.end(), [](const PatchPair& a, const PatchPair& b) {
    return a.energy < b.energy;
  });
  std::map<PhotoPair, Correlations> sums;
  const size_t num_calm = (pairs.size() + options.calm_one_in - 1) / options.calm_one_in;
  for (size_t i = 0; i < num_calm; ++i) {
    Correlations& sum = sums.try_emplace(pairs[i].Photos(), Correlations::Zero()).first->second;
    const BandPatch second = pairs[i].second->Both();
    const Eigen::Array<float, kInside, kInside> a =
        pairs[i].first->Both().block<kInside, kInside>(kShift, kShift);
    const float energy = a.square().sum();
    for (int y = 0; y < kNumShifts; ++y) {
      for (int x = 0; x < kNumShifts; ++x) {
        const auto b = second.block<kInside, kInside>(y, x);
        sum(y, x) += (a * b).sum() / std::sqrt(energy * b.square().sum() + 1e-12f);
      }
    }
  }
  Agreement agreement;
  for (const auto& [photos, sum] : sums) agreement.sum += sum.maxCoeff();
  agreement.count = static_cast<double>(num_calm);
  return agreement;
}

// The charts' certainty from their agreement.
std::vector<double> Certainty(const std::vector<Agreement>& agreements,
                              const GrainOptions& options) {
  Agreement all;
  for (const Agreement& chart : agreements) {
    all.sum += chart.sum;
    all.count += chart.count;
  }
  std::vector<double> certainty(agreements.size(), 0);
  if (all.count == 0) return certainty;
  for (size_t i = 0; i < agreements.size(); ++i) {
    const double agreement = (agreements[i].sum + options.few_patches * all.sum / all.count) /
                             (agreements[i].count + options.few_patches);
    certainty[i] = std::clamp((options.detail_agreement - agreement) /
                                  (options.detail_agreement - options.grain_agreement),
                              0.0,
                              1.0);
  }
  return certainty;
}

// The photographs' variances in one band from what differs between pairs of them.
std::vector<double> SolveVariances(const std::map<PhotoPair, std::vector<float>>& differences,
                                   size_t num_photos,
                                   const GrainOptions& options) {
  const auto size = static_cast<Eigen::Index>(num_photos);
  Eigen::MatrixXd normal = options.prior_patches * Eigen::MatrixXd::Identity(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  std::vector<double> halves;
  for (const auto& [photos, unsorted] : differences) {
    if (static_cast<int>(unsorted.size()) < options.fewest_patches) continue;
    const double weight = static_cast<double>(unsorted.size());
    const float calm = ValueOfRank(unsorted, static_cast<size_t>(options.calm_quantile * weight));
    for (const int i : {photos.first, photos.second}) {
      right[i] += weight * calm;
      for (const int j : {photos.first, photos.second}) normal(i, j) += weight;
    }
    halves.push_back(calm / 2);
  }
  if (halves.empty()) return std::vector<double>(num_photos, 0);
  right.array() += options.prior_patches * UpperMedian(std::move(halves));
  const Eigen::VectorXd variances = SolveBounded(normal, right, 0);
  return {variances.begin(), variances.end()};
}

// Texels' luma in codes of 0 to 255, in 1/256ths.
template <typename Code>
Image16 LumaOf(const Raster<Code>& srgb) {
  constexpr float kScale = 256 * 255.0f / std::numeric_limits<Code>::max();
  Image16 luma(srgb.width, srgb.height, 1);
  tbb::parallel_for(0, srgb.height, [&](int y) {
    const Code* from = srgb.At(0, y);
    uint16_t* to = luma.At(0, y);
    for (int x = 0; x < srgb.width; ++x, from += 3) {
      to[x] = static_cast<uint16_t>(kScale * Luma(from[0], from[1], from[2]) + 0.5f);
    }
  });
  return luma;
}

// variances[provenance][band], in codes of 0 to 255.
template <typename Code>
void Smooth(const std::vector<std::array<float, kGrainBands>>& variances,
            const Image16& provenance,
            Raster<Code>& srgb) {
  constexpr int kBandRows = 48;
  constexpr int kReachRows = 10;  // of the filters: 2 and 4, and 4 of the energy
  constexpr float kLargest = std::numeric_limits<Code>::max();
  const Image16 luma = LumaOf(srgb);
  const int width = srgb.width;
  tbb::parallel_for(0, (srgb.height + kBandRows - 1) / kBandRows, [&](int index) {
    const int y0 = index * kBandRows;
    const int y1 = std::min(srgb.height, y0 + kBandRows);
    const int top = std::max(0, y0 - kReachRows);
    const int bottom = std::min(srgb.height, y1 + kReachRows);
    Plane in(bottom - top, width);
    for (int y = top; y < bottom; ++y) {
      std::transform(luma.At(0, y), luma.At(0, y) + width, in[y - top], [](uint16_t value) {
        return value / 256.0f;
      });
    }
    const Bands split = SplitBands(in);
    std::array<Plane, kGrainBands> energies;
    for (int b = 0; b < kGrainBands; ++b) {
      energies[b] = Smoothed(split.bands[b].mul(split.bands[b]), 1 << b);
    }
    for (int y = y0; y < y1; ++y) {
      const uint16_t* source = provenance.At(0, y);
      Code* codes = srgb.At(0, y);
      for (int x = 0; x < width; ++x, codes += 3) {
        float grain = 0;
        for (int b = 0; b < kGrainBands; ++b) {
          const float energy = energies[b](y - top, x) + 1e-3f;
          grain += std::min(1.0f, variances[source[x]][b] / energy) * split.bands[b](y - top, x);
        }
        grain *= kLargest / 255;
        for (int c = 0; c < 3; ++c) {
          codes[c] = static_cast<Code>(std::clamp(codes[c] - grain, 0.0f, kLargest) + 0.5f);
        }
      }
    }
  });
}

// All pairs of views of one patch, by chart; and how much they differ in each band, by photographs.
struct PairsAndDifferences {
  std::vector<std::vector<PatchPair>> pairs;
  std::array<std::map<PhotoPair, std::vector<float>>, kGrainBands> differences;
};

PairsAndDifferences ComparePatches(const std::vector<Patch>& patches,
                                   const std::vector<std::vector<PatchBands>>& views,
                                   size_t num_charts,
                                   const GrainOptions& options) {
  PairsAndDifferences found;
  found.pairs.resize(num_charts);
  for (size_t i = 0; i < patches.size(); ++i) {
    for (size_t a = 0; a < views[i].size(); ++a) {
      for (size_t b = a + 1; b < views[i].size(); ++b) {
        const PatchPair& pair =
            found.pairs[patches[i].chart].emplace_back(views[i][a], views[i][b]);
        if (std::min(pair.first->mean, pair.second->mean) < options.dark) continue;
        const float ratio = pair.first->mean / pair.second->mean;
        for (int band = 0; band < kGrainBands; ++band) {
          found.differences[band][pair.Photos()].push_back(
              (pair.first->bands[band] - ratio * pair.second->bands[band]).square().mean());
        }
      }
    }
  }
  return found;
}

}  // namespace

Grain MeasureGrain(const std::vector<Patch>& patches,
                   size_t num_charts,
                   size_t num_photos,
                   const GrainOptions& options) {
  std::vector<std::vector<PatchBands>> views(patches.size());
  tbb::parallel_for(size_t{0}, patches.size(), [&](size_t i) {
    for (const PatchView& view : patches[i].views) views[i].push_back(SplitPatch(view));
  });
  PairsAndDifferences found = ComparePatches(patches, views, num_charts, options);
  Grain grain;
  std::vector<Agreement> agreements(num_charts);
  tbb::parallel_for(size_t{0}, num_charts, [&](size_t chart) {
    agreements[chart] = MeasureAgreement(std::move(found.pairs[chart]), options);
  });
  grain.certainty = Certainty(agreements, options);
  grain.variances.resize(num_photos);
  for (int band = 0; band < kGrainBands; ++band) {
    const std::vector<double> variances =
        SolveVariances(found.differences[band], num_photos, options);
    for (size_t photo = 0; photo < num_photos; ++photo) {
      grain.variances[photo][band] = variances[photo];
    }
  }
  return grain;
}

void SmoothGrain(const GrainInputs& inputs, const GrainOptions& options, ChartPixels& pixels) {
  const Grain& grain = inputs.grain;
  const double certainty = grain.certainty[inputs.chart_index];
  if (certainty <= 0) return;
  std::vector<std::vector<float>> footprints(grain.variances.size());
  for (const FaceSource& source : pixels.sources) {
    std::vector<float>& all = footprints[source.photo];
    all.insert(all.end(), source.footprints.begin(), source.footprints.end());
  }
  std::vector<std::array<float, kGrainBands>> variances(grain.variances.size() + 1, {0, 0});
  for (size_t k = 0; k < inputs.blocks.photos.size(); ++k) {
    const int photo = inputs.blocks.photos[k];
    if (footprints[photo].empty()) continue;
    // Texels of several pixels have less grain.
    const double texel_px = std::max(1.0, inputs.chart.texel_size / UpperMedian(footprints[photo]));
    // A correction multiplies radiance; codes go with its root of about 2.4.
    const double log_gain =
        inputs.colour
            .Correction(photo, inputs.chart_index, static_cast<int>(k), options.vignetting_at)
            .log()
            .mean() /
        2.4;
    for (int b = 0; b < kGrainBands; ++b) {
      variances[photo + 1][b] =
          static_cast<float>(certainty * 255 * 255 * grain.variances[photo][b] *
                             std::exp(2 * log_gain) / (texel_px * texel_px));
    }
  }
  if (pixels.srgb16.Empty()) {
    Smooth(variances, pixels.provenance, pixels.srgb8);
  } else {
    Smooth(variances, pixels.provenance, pixels.srgb16);
  }
}

}  // namespace groundglass
