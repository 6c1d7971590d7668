// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/textured_model.h"

#include <array>
#include <filesystem>
#include <vector>

namespace groundglass {

// The texels of a textured model against the exact colours of truth/surfaces.
struct TexelErrors {
  long num_texels = 0;   // of the truth, exact ones
  long num_covered = 0;  // that some photograph gave a colour
  // Root mean square over the covered ones and the channels, in 8-bit sRGB levels, after one gain
  // for each channel has been fitted to the encoded values, as for novel views.
  double rms_levels = 0;
  std::array<double, 3> gain = {1, 1, 1};
  // The same for each face of the model, with the gains of all.
  struct OfFace {
    long num_texels = 0;
    long num_covered = 0;
    double rms_levels = 0;
  };
  std::vector<OfFace> faces;
};

// Averages the model's pages over the square of each exact texel of the truth, in linear light.
// Throws Error naming the file that is not as WriteSurfaces writes it.
TexelErrors MeasureTexels(const TexturedModel& model, const std::filesystem::path& surfaces_folder);

}  // namespace groundglass
