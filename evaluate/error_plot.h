// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "evaluate/evaluate.h"
#include "evaluate/trials.h"

#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// One photograph, or one trial of it, as the plot shows it.
struct ErrorPlotPoint {
  std::string name;
  // Vertex errors of the tag as measured and as found, in px at the photograph's own size or at 640
  // wide; left out of the first panel where the start is not known (0).
  double start_px = 0;
  double end_px = 0;
  // Of the camera's place, in the model's unit; left out of the second panel where no sigma is
  // claimed (0).
  double position_error = 0;
  double position_sigma = 0;
  std::optional<Verdict> verdict;
};

std::vector<ErrorPlotPoint> PlotPointsOf(const Evaluation& evaluation);
std::vector<ErrorPlotPoint> PlotPointsOf(const std::vector<Trial>& trials);

// Two panels side by side, both scales logarithmic: the error found against the error at the start,
// under the line where nothing is gained; the error of position against the sigma claimed for it,
// with the line of 1 sigma and the 95 % line of three equal axes. SVG with a title for each point.
std::string FormatErrorPlot(const std::vector<ErrorPlotPoint>& points,
                            const std::string& title,
                            const std::string& unit);

}  // namespace groundglass
