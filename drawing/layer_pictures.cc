// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/layer_pictures.h"

#include "drawing/drawing_accuracy.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace groundglass {
namespace {

using Colour = std::array<uint8_t, 3>;

constexpr Colour kPaper = {255, 255, 255};
constexpr Colour kFilled = {190, 190, 190};

// Steps of the golden ratio on the circle of hues.
Colour ColourOfNumber(int number) {
  const double hue = 6 * std::fmod(number * 0.61803398875 + 0.1, 1.0);
  Colour colour;
  for (int channel = 0; channel < 3; ++channel) {
    const double wave = std::abs(std::fmod(hue + 4.0 - 2.0 * channel, 6.0) - 3.0) - 1.0;
    colour[channel] = static_cast<uint8_t>(std::lround(90 + 140 * std::clamp(wave, 0.0, 1.0)));
  }
  return colour;
}

// From blue, sure, to red.
constexpr std::array<Colour, 5> kSteps = {
    {{69, 117, 180}, {145, 191, 219}, {254, 224, 144}, {252, 141, 89}, {215, 48, 39}}};

template <typename T, typename ColourOf>
Image8 Coloured(const Raster<T>& values, const ColourOf& colour_of) {
  Image8 picture(values.width, values.height, 3);
  for (size_t i = 0; i < values.values.size(); ++i) {
    const Colour colour = colour_of(values.values[i]);
    std::copy(colour.begin(), colour.end(), &picture.values[3 * i]);
  }
  return picture;
}

}  // namespace

LayerPicture PicturePhotographs(const DrawingLayers& layers,
                                const DrawingGrid& grid,
                                const DrawingSources& sources) {
  LayerPicture layer;
  layer.name = "Photographs";
  layer.pixel_size = grid.pixel_size;
  const Image16 numbers = layers.Photographs(0, grid.height_px);
  layer.srgb8 = Coloured(numbers, [](uint16_t number) {
    if (number == kProvenanceNone) return kPaper;
    return number == kProvenanceFilled ? kFilled : ColourOfNumber(number);
  });
  const std::set<uint16_t> seen(numbers.values.begin(), numbers.values.end());
  for (const uint16_t number : seen) {
    if (number == kProvenanceNone) continue;
    if (number == kProvenanceFilled) {
      layer.legend.push_back({kFilled, "filled in"});
    } else {
      layer.legend.push_back({ColourOfNumber(number), sources.photographs[number - 1]});
    }
  }
  return layer;
}

LayerPicture PictureSigmas(const DrawingLayers& layers, const DrawingGrid& grid) {
  LayerPicture layer;
  layer.name = "Uncertainty";
  layer.pixel_size = grid.pixel_size;
  const ImageF sigmas = layers.Sigmas(0, grid.height_px);
  float least = 1e30f;
  float most = 0;
  for (const float sigma : sigmas.values) {
    if (std::isnan(sigma)) continue;
    least = std::min(least, sigma);
    most = std::max(most, sigma);
  }
  const double step = std::max(1e-12, (most - least) / static_cast<double>(kSteps.size()));
  layer.srgb8 = Coloured(sigmas, [&](float sigma) {
    if (std::isnan(sigma)) return kPaper;
    const auto place = static_cast<int>((sigma - least) / step);
    return kSteps[std::clamp(place, 0, static_cast<int>(kSteps.size()) - 1)];
  });
  if (most <= 0) return layer;
  for (size_t i = 0; i < kSteps.size(); ++i) {
    layer.legend.push_back({kSteps[i], "to " + FormatLength(least + (i + 1.0) * step)});
  }
  return layer;
}

}  // namespace groundglass
