// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "evaluate/trials.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// For one scene, the confidence of each truth: the level, 0 to 1, of the smallest ellipsoid of its
// claimed covariance that holds it. Where claims are right these are uniform.
struct CalibrationCurve {
  std::string name;
  std::vector<double> confidences;

  // Which share of the truths the ellipsoids of this level hold.
  double ShareInside(double level) const;
};

// Of the trials whose covariance is judged: accepted, and without a blunder.
CalibrationCurve CalibrationCurveOf(const std::string& name, const std::vector<Trial>& trials);
// The same from what `evaluate --trials --json` printed. Throws Error naming the file.
CalibrationCurve ReadCalibrationCurve(const std::string& name, const std::filesystem::path& file);

// The share of truths inside against the level claimed, a curve for each scene. On the diagonal
// claims are right, below it covariances are too small. The bar at 95 % is what is asked for, 90
// to 98 %. SVG; curves tell their names when pointed at.
std::string FormatCalibrationPlot(const std::vector<CalibrationCurve>& curves);

}  // namespace groundglass
