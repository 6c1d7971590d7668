// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <cstdint>
#include <vector>

namespace groundglass {

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
  Image16 srgb16;      // PageOptions::bits
  Image16 provenance;  // photo + 1, or kProvenanceNone
  Raster<uint8_t> states;
  Raster<uint8_t> reach;            // of weak texels: how many texels away good ones may be
  std::vector<FaceSource> sources;  // ordered by face, then photograph
};

}  // namespace groundglass
