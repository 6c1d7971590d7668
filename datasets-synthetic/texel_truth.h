// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/daylight.h"
#include "datasets-synthetic/synthetic_world.h"
#include "scene/textured_model.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// The exact colour of a small square of a wall: linear light under the novel views' overcast sky,
// without what glass mirrors.
struct TexelSample {
  int face = -1;                                       // of the model, from 0
  Eigen::Vector3d in_world = Eigen::Vector3d::Zero();  // the square's middle, on the face
  Rgb color = Rgb::Zero();
};
// The squares' width, feet: about what a slide resolves from across a plaza.
constexpr double kTexelSampleWidth = 0.25;

// Samples all over the building, about `count` in proportion to the faces' areas and a few at least
// on each. Left out are glass, relief, and places with something right before them.
std::vector<TexelSample> SampleTexels(const SyntheticWorld& world,
                                      const PolygonModel& model,
                                      const Visibility& visibility,
                                      const SkyMap& sky_map,
                                      const Daylight& light,
                                      int count,
                                      uint64_t seed);

// truth/texels.csv: `face,x,y,z,red,green,blue`; faces from 1, positions in `site`.
std::string FormatTexels(const std::vector<TexelSample>& samples);
// Throws Error naming file and line.
std::vector<TexelSample> ReadTexels(const std::filesystem::path& file);

// Texels of a textured model against the exact colours.
struct TexelErrors {
  long num_samples = 0;
  long num_covered = 0;  // that some photograph gave a colour
  // Root mean square over the covered ones and the channels, in 8-bit sRGB levels, after one gain
  // for each channel has been fitted to the encoded values, as for novel views.
  double rms_levels = 0;
  std::array<double, 3> gain = {1, 1, 1};
  // The same for each face of the model, with the gains of all.
  struct OfFace {
    long num_covered = 0;
    double rms_levels = 0;
  };
  std::vector<OfFace> faces;
};
TexelErrors MeasureTexels(const TexturedModel& model, const std::vector<TexelSample>& samples);

}  // namespace groundglass
