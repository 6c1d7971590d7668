// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/colour/colour.h"
#include "invrender/compose/compose_inputs.h"
#include "invrender/inputs/bake_options.h"
#include "scene/coverage.h"
#include "scene/textured_model.h"

#include <vector>

namespace groundglass {

// ComposeChart looks texels up in bands of so many, or of a few rows.
constexpr int kBandTexels = 1 << 20;

// What is known of a texel.
enum class TexelState : uint8_t {
  kOutside,  // no face there
  kOpen,     // a face that no photograph shows
  kWeak,     // seen only so close to a border that the photograph may show something else
  kGood,
};

// One photograph's part in one face.
struct FaceSource {
  int face = -1;
  int photo = -1;
  long num_texels = 0;
  std::vector<float> footprints;  // of some texels: the pixel's size on the face, model's unit
};

// A chart's texels, ready to be copied to its page.
struct ChartPixels {
  Image8 srgb8;        // empty if there is srgb16
  Image16 srgb16;      // BakeOptions::bits
  Image16 provenance;  // photo + 1, or kProvenanceNone
  Raster<uint8_t> states;
  Raster<uint8_t> reach;            // of weak texels: how many texels away good ones may be
  std::vector<FaceSource> sources;  // ordered by face, then photograph
};

// Fills a chart at full resolution: each texel from the photographs that its block and the blocks
// around it chose, blended across the seam between them, and from the others where those do not
// see it. Colours are corrected and in the chart's own light.
ChartPixels ComposeChart(const ComposeInputs& inputs,
                         const ColourModel& colour,
                         const BakeOptions& options);

}  // namespace groundglass
