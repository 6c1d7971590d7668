// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/outline_sides.h"

#include <array>
#include <optional>
#include <vector>

namespace groundglass {

// The corners of an outline, as its sides name them.
struct Outline {
  const Eigen::Vector2d& At(int corner) const { return corners[corner]; }

  const std::vector<Eigen::Vector2d>& corners;
  double tolerance = 0;   // what lies nearer than this is at the same place
  std::vector<int> weld;  // WeldCorners
};

// Two sides that have more in common than an end, if there are any; the first in the outline's
// order are not looked for.
std::optional<std::array<OutlineSide, 2>> FindMeetingSides(const Outline& outline,
                                                           const std::vector<OutlineSide>& sides);

// Follows the sides with the area on the left, into `result`. Where loops touch, the sharpest turn
// to the left keeps to the same piece of the area. Where there is no such way, `result` says which
// sides meet, and has no loops.
void TraceLoops(const Outline& outline,
                const std::vector<OutlineSide>& sides,
                OutlineLoops& result);

// Loops in an odd number of others are holes in the smallest of these, and run the other way round;
// those that do not are turned, which is noted.
void OrientLoops(const Outline& outline, OutlineLoops& result);

}  // namespace groundglass
