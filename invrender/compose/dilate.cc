// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "invrender/compose/dilate.h"

#include "scene/textured_model.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace groundglass {
namespace {

template <typename Code>
struct GrownTexel {
  int x;
  int y;
  Code colour[3];
  uint16_t provenance;
};

// One ring: every texel that `wants` a colour and has neighbours that are `known` gets their mean.
// Returns the texels that were filled; they become known.
template <typename Code>
std::vector<GrownTexel<Code>> GrowRing(const std::vector<std::pair<int, int>>& candidates,
                                       const Raster<Code>& srgb,
                                       const Image16& provenance,
                                       const Raster<uint8_t>& known) {
  std::vector<GrownTexel<Code>> filled;
  for (const auto& [x, y] : candidates) {
    int sum[3] = {0, 0, 0};
    int count = 0;
    uint16_t source = kProvenanceNone;
    for (int j = std::max(0, y - 1); j <= std::min(known.height - 1, y + 1); ++j) {
      for (int i = std::max(0, x - 1); i <= std::min(known.width - 1, x + 1); ++i) {
        if (!*known.At(i, j)) continue;
        for (int c = 0; c < 3; ++c) sum[c] += srgb.At(i, j)[c];
        if (source == kProvenanceNone) source = *provenance.At(i, j);
        ++count;
      }
    }
    if (count == 0) continue;
    GrownTexel<Code> texel{x, y, {}, source};
    for (int c = 0; c < 3; ++c) texel.colour[c] = static_cast<Code>((sum[c] + count / 2) / count);
    filled.push_back(texel);
  }
  return filled;
}

// Grows colour from `known` into `wanted`, ring by ring; each wanted texel's value is the last ring
// that may reach it.
template <typename Code>
void Dilate(Raster<Code>& srgb,
            Image16& provenance,
            Raster<uint8_t>& known,
            Raster<uint8_t>& wanted,
            bool keep_provenance) {
  const auto neighbours = [&](int x, int y, auto&& visit) {
    for (int j = std::max(0, y - 1); j <= std::min(known.height - 1, y + 1); ++j) {
      for (int i = std::max(0, x - 1); i <= std::min(known.width - 1, x + 1); ++i) visit(i, j);
    }
  };
  Raster<uint8_t> queued(known.width, known.height, 1);
  std::vector<std::pair<int, int>> frontier;
  for (int y = 0; y < known.height; ++y) {
    for (int x = 0; x < known.width; ++x) {
      if (!*wanted.At(x, y)) continue;
      bool is_beside_known = false;
      neighbours(x, y, [&](int i, int j) { is_beside_known |= *known.At(i, j) != 0; });
      if (!is_beside_known) continue;
      *queued.At(x, y) = 1;
      frontier.emplace_back(x, y);
    }
  }
  for (int ring = 1; !frontier.empty(); ++ring) {
    std::erase_if(frontier, [&](const auto& at) { return *wanted.At(at.first, at.second) < ring; });
    const std::vector<GrownTexel<Code>> filled = GrowRing(frontier, srgb, provenance, known);
    for (const GrownTexel<Code>& texel : filled) {
      std::copy(texel.colour, texel.colour + 3, srgb.At(texel.x, texel.y));
      if (!keep_provenance) *provenance.At(texel.x, texel.y) = texel.provenance;
      *known.At(texel.x, texel.y) = 1;
      *wanted.At(texel.x, texel.y) = 0;
      *queued.At(texel.x, texel.y) = 1;
    }
    frontier.clear();
    for (const GrownTexel<Code>& texel : filled) {
      neighbours(texel.x, texel.y, [&](int i, int j) {
        if (*wanted.At(i, j) == 0 || *queued.At(i, j)) return;
        *queued.At(i, j) = 1;
        frontier.emplace_back(i, j);
      });
    }
  }
}

void Dilate(ChartPixels& pixels,
            Raster<uint8_t>& known,
            Raster<uint8_t>& wanted,
            bool keep_provenance) {
  if (pixels.srgb16.Empty()) {
    Dilate(pixels.srgb8, pixels.provenance, known, wanted, keep_provenance);
  } else {
    Dilate(pixels.srgb16, pixels.provenance, known, wanted, keep_provenance);
  }
}

// The chart with its gutter, in the codes that it has.
template <typename Code>
void Place(const Chart& chart,
           const ChartPixels& pixels,
           const Raster<Code>& chart_srgb,
           int gutter_texels,
           TexturePage& page,
           Raster<Code>& page_srgb) {
  constexpr int kScale = std::numeric_limits<Code>::max() / 255;
  const auto open_code = static_cast<Code>(kScale * kNoPhotographSrgb8);
  const int width = chart.width_texels + 2 * gutter_texels;
  const int height = chart.height_texels + 2 * gutter_texels;
  Raster<Code> srgb(width, height, 3);
  Image16 provenance(width, height, 1);
  Raster<uint8_t> known(width, height, 1);
  Raster<uint8_t> wanted(width, height, 1, static_cast<uint8_t>(gutter_texels));
  for (int y = 0; y < chart.height_texels; ++y) {
    for (int x = 0; x < chart.width_texels; ++x) {
      const int to_x = x + gutter_texels;
      const int to_y = y + gutter_texels;
      const auto state = static_cast<TexelState>(*pixels.states.At(x, y));
      if (state == TexelState::kOutside) continue;
      *wanted.At(to_x, to_y) = 0;
      *known.At(to_x, to_y) = 1;
      if (state == TexelState::kOpen) {
        std::fill_n(srgb.At(to_x, to_y), 3, open_code);
        continue;
      }
      std::copy_n(chart_srgb.At(x, y), 3, srgb.At(to_x, to_y));
      *provenance.At(to_x, to_y) = *pixels.provenance.At(x, y);
    }
  }
  Dilate(srgb, provenance, known, wanted, true);
  for (int y = 0; y < height; ++y) {
    const int page_y = chart.y_on_page - gutter_texels + y;
    const int page_x = chart.x_on_page - gutter_texels;
    std::copy_n(srgb.At(0, y), 3 * width, page_srgb.At(page_x, page_y));
    std::copy_n(provenance.At(0, y), width, page.provenance.At(page_x, page_y));
  }
}

}  // namespace

void InpaintBorders(ChartPixels& pixels) {
  Raster<uint8_t> known(pixels.states.width, pixels.states.height, 1);
  Raster<uint8_t> wanted(pixels.states.width, pixels.states.height, 1);
  for (size_t i = 0; i < pixels.states.values.size(); ++i) {
    const auto state = static_cast<TexelState>(pixels.states.values[i]);
    known.values[i] = state == TexelState::kGood;
    wanted.values[i] = state == TexelState::kWeak ? pixels.reach.values[i] : 0;
  }
  Dilate(pixels, known, wanted, false);
}

void CloseHoles(const DilateOptions& options, ChartPixels& pixels) {
  const int width = pixels.states.width;
  const int height = pixels.states.height;
  // The first texel that is not open in one direction: outside the chart counts as kOutside;
  // kOpen if there is none within reach.
  const auto look = [&](int x, int y, int dx, int dy) {
    for (int step = 1; step <= options.slit_texels; ++step) {
      const int i = x + step * dx;
      const int j = y + step * dy;
      if (i < 0 || j < 0 || i >= width || j >= height) return TexelState::kOutside;
      const auto state = static_cast<TexelState>(*pixels.states.At(i, j));
      if (state != TexelState::kOpen) return state;
    }
    return TexelState::kOpen;
  };
  const auto is_slit = [](TexelState a, TexelState b) {
    return a != TexelState::kOpen && b != TexelState::kOpen &&
           (a != TexelState::kOutside || b != TexelState::kOutside);
  };
  Raster<uint8_t> known(width, height, 1);
  Raster<uint8_t> wanted(width, height, 1);
  std::vector<size_t> slits;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto state = static_cast<TexelState>(*pixels.states.At(x, y));
      *known.At(x, y) = state == TexelState::kGood || state == TexelState::kWeak;
      if (state != TexelState::kOpen) continue;
      if (!is_slit(look(x, y, -1, 0), look(x, y, 1, 0)) &&
          !is_slit(look(x, y, 0, -1), look(x, y, 0, 1))) {
        continue;
      }
      *wanted.At(x, y) = static_cast<uint8_t>(options.slit_texels);
      slits.push_back(static_cast<size_t>(y) * width + x);
    }
  }
  if (slits.empty()) return;
  Dilate(pixels, known, wanted, true);
  for (const size_t i : slits) {
    if (!known.values[i]) continue;
    pixels.provenance.values[i] = kProvenanceFilled;
    pixels.states.values[i] = static_cast<uint8_t>(TexelState::kWeak);
  }
}

void PlaceOnPage(const Chart& chart,
                 const ChartPixels& pixels,
                 int gutter_texels,
                 TexturePage& page) {
  if (pixels.srgb16.Empty()) {
    Place(chart, pixels, pixels.srgb8, gutter_texels, page, page.srgb8);
    return;
  }
  Place(chart, pixels, pixels.srgb16, gutter_texels, page, page.srgb16);
  // The same in 8 bits.
  const int x0 = chart.x_on_page - gutter_texels;
  const int num_codes = 3 * (chart.width_texels + 2 * gutter_texels);
  for (int y = -gutter_texels; y < chart.height_texels + gutter_texels; ++y) {
    const uint16_t* from = page.srgb16.At(x0, chart.y_on_page + y);
    std::transform(
        from, from + num_codes, page.srgb8.At(x0, chart.y_on_page + y), [](uint16_t code) {
          return static_cast<uint8_t>((code + 128) / 257);
        });
  }
}

}  // namespace groundglass
