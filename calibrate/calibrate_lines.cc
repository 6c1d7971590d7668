// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "calibrate/calibrate_lines.h"

#include "calibrate/building_axes.h"
#include "calibrate/line_segments.h"
#include "calibrate/lines_solver.h"
#include "scene/check_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {

void LinesOptions::Check() const {
  CheckAbove(center_sigma, 0, "lines options: center_sigma");
  CheckAbove(k1_sigma, 0, "lines options: k1_sigma");
  CheckFromTo(shortest_share, 0.001, 0.5, "lines options: shortest_share");
  CheckFromTo(min_segments_of_direction, 2, 1e6, "lines options: min_segments_of_direction");
  CheckFromTo(min_segments, 4, 1e6, "lines options: min_segments");
  CheckAtLeast(inflation, 1, "lines options: inflation");
  CheckAbove(worst_view_angle_share, 0, "lines options: worst_view_angle_share");
  CheckAtLeast(rival_share, 0, "lines options: rival_share");
  if (aspect) CheckFromTo(*aspect, 0.1, 10, "aspect");
  CheckAtLeast(aspect_sigma, 0, "lines options: aspect_sigma");
  CheckAbove(worst_aspect_share, 0, "lines options: worst_aspect_share");
}

LinesResult CalibrateLines(const Image8& srgb_grey, const LinesOptions& options, uint64_t seed) {
  options.Check();
  LinesResult none;
  if (options.aspect && options.aspect_sigma > options.worst_aspect_share * *options.aspect) {
    none.reason = fmt::format(
        "the shape of its pixels is not known (width / height {:.2f} to {:.2f}); --aspect tells it",
        *options.aspect - options.aspect_sigma,
        *options.aspect + options.aspect_sigma);
    return none;
  }
  std::vector<LineSegment> segments =
      FindLineSegments(srgb_grey, options.shortest_share * srgb_grey.width);
  // As if the picture's pixels were square and as wide as they are.
  const double width = srgb_grey.width;
  const double stretch = options.aspect ? width / (*options.aspect * srgb_grey.height) : 1;
  const Eigen::Vector2d middle_px(width / 2, stretch * srgb_grey.height / 2);
  for (LineSegment& segment : segments) {
    segment.begin_px.y() *= stretch;
    segment.end_px.y() *= stretch;
  }
  const std::vector<LinesCamera> starts = FindBuildingAxes(segments, middle_px, width, seed);
  struct Found {
    LinesSolver solver;
    double cost = 0;
  };
  std::vector<Found> found;
  for (const LinesCamera& start : starts) {
    LinesSolver solver(segments, middle_px, options);
    if (!solver.Solve(start)) continue;
    const double cost = solver.Cost();
    found.push_back({std::move(solver), cost});
  }
  if (found.empty()) {
    none.reason = "too few lines (" + std::to_string(segments.size()) +
                  ") follow two directions at right angles";
    return none;
  }
  std::stable_sort(
      found.begin(), found.end(), [](const Found& a, const Found& b) { return a.cost < b.cost; });
  LinesResult result = found.front().solver.Result();
  if (!result.is_found) return result;
  if (!(result.sigma_view_angle_deg < options.worst_view_angle_share * result.view_angle_deg)) {
    none.reason =
        "the lines leave the view angle open, as those of one wall seen from the front do";
    return none;
  }
  for (const Found& other : found) {
    if (other.cost > found.front().cost * (1 + options.rival_share)) break;
    const double ratio = other.solver.Focal() / found.front().solver.Focal();
    if (std::abs(std::log(ratio)) > 4 * options.worst_view_angle_share) {
      none.reason = "two cameras suit the lines as well";
      return none;
    }
  }
  return result;
}

KnownKeys KeysOfLines(const LinesResult& result, const LinesOptions& options) {
  constexpr double kTellsShare = 0.7;  // of what was known before
  KnownKeys keys;
  if (!result.is_found) return keys;
  const std::string lines = std::to_string(result.num_segments) + " lines";
  AddKnown(keys, "v", result.view_angle_deg, lines);
  AddKnown(keys, "sigma_v", result.sigma_view_angle_deg);
  AddKnown(keys, "roll", result.roll_deg);
  AddKnown(keys, "sigma_roll", result.sigma_roll_deg);
  const double sigma_shift = std::max(result.sigma_shift_x, result.sigma_shift_y);
  if (sigma_shift < kTellsShare * options.center_sigma) {
    AddKnown(keys, "shift_x", result.shift_x);
    AddKnown(keys, "shift_y", result.shift_y);
    AddKnown(keys, "sigma_shift", sigma_shift);
  }
  if (result.sigma_k1 < kTellsShare * options.k1_sigma) {
    AddKnown(keys, "k1", result.k1);
    AddKnown(keys, "sigma_k1", result.sigma_k1);
  }
  return keys;
}

}  // namespace groundglass
