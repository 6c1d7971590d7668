// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// Which faces share a chart, and how it lies (MakeCharts).
struct ChartOptions {
  // Faces lie in one plane if the sine of the angle between them is no larger, and their planes
  // are no farther apart, as a share of the model's diagonal. Raise both for models with coarsely
  // rounded coordinates.
  double coplanar_sine = 1e-4;
  double coplanar_share = 1e-5;
  // Faces whose normal's sine to the vertical is smaller are level: nothing says which way is up.
  double level_sine = 0.02;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "chart options: ") const;
};

}  // namespace groundglass
