// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// How small holes are closed (CloseHoles).
struct DilateOptions {
  // Open texels with others that are covered, or an end of the chart, on both sides within so many
  // texels are in a slit or a speck. Raise it where models have wider cracks than that.
  int slit_texels = 3;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "dilate options: ") const;
};

// How what no photograph shows is painted over (FillOpenTexels).
struct FillOptions {
  // Texels around one that speak for it. Larger radii are smoother, and slower.
  double radius_texels = 4;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "fill options: ") const;
};

}  // namespace groundglass
