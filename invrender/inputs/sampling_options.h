// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// How a texel's footprint in a photograph is filtered (PhotoPyramid::Sample).
struct SamplingOptions {
  // Taps along a side of the footprint; larger ones are served by a coarser level.
  int max_taps = 4;
  // Footprints no longer than this take one tap, px.
  double one_tap_px = 1.25;
  // A long thin footprint keeps the level of its short side as far as this ratio allows.
  double max_anisotropy = 4;
  // Footprints with no more taps than this have bicubic ones, others bilinear.
  int bicubic_taps = 4;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "sampling options: ") const;
};

}  // namespace groundglass
