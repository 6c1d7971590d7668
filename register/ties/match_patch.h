// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <optional>
#include <string>

namespace groundglass {

struct PatchMatchOptions {
  // The two must correlate at least this much at the best place.
  double min_correlation = 0.75;
  // And elsewhere, further than `peak_texels` from there, less by this at least: not a pattern that
  // repeats itself, nor a line that may slide along itself.
  double min_lead = 0.1;
  int peak_texels = 3;
  // The offset's standard deviation along its worse direction may be no more than this, texels.
  double max_sigma_texels = 0.35;
  // How many texels err together (blur, interpolation, what truly differs): noise averages out over
  // this many times fewer.
  double correlated_texels = 6;
  // What light, relief and resampling leave at the least, texels.
  double floor_texels = 0.2;

  // Throws Error naming the first field out of range, behind `path`.
  void Check(const std::string& path = "patch match options: ") const;
};

struct PatchMatch {
  // From where the patch would lie if nothing were off, texels: columns to the right, rows down.
  Eigen::Vector2d offset_texels = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  // texels^2
  double correlation = 0;
};

// Finds `patch` (light, 1 channel) in `surroundings`, which reach equally far beyond it on all
// sides: whole texels by correlation, then parts of them by enhanced correlation (Evangelidis and
// Psarakis, PAMI 2008). Neither a gain nor an offset of the light matters. Nothing if they do not
// correlate, or if the place is not unique.
std::optional<PatchMatch> MatchPatch(const ImageF& patch,
                                     const ImageF& surroundings,
                                     const PatchMatchOptions& options);

}  // namespace groundglass
