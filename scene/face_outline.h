// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"

#include <Eigen/Dense>

#include <array>
#include <optional>
#include <vector>

namespace groundglass {

// Modelling programs cut a window out of a wall with one outline: it runs over a bridge to the
// hole, around it, and back over the same bridge. A side that is walked both ways bounds nothing.
// Corners are places in Face::points.

// A side of an outline, from one corner to the next.
struct OutlineSide {
  int start = 0;
  int end = 0;
};

// The sides that bound the face: all of them in order, but for bridges.
std::vector<OutlineSide> FindBorders(const PolygonModel& model, int face);

// The face cut into triangles of its corners, all with the face's own winding; holes stay open.
std::vector<std::array<int, 3>> TriangulateCorners(const PolygonModel& model, int face);

// An outline in its plane (counterclockwise as the face is seen), parted into the loops that bound
// its area.
struct OutlineLoops {
  struct Loop {
    std::vector<int> corners;  // the area lies on their left
    int inside_of = -1;        // of a hole: the loop it is cut from; -1 for an outer loop
  };
  std::vector<Loop> loops;
  bool is_plain = true;    // no corner is met twice: one loop, the outline itself
  bool is_turned = false;  // a hole ran the same way round as its outline; here it is turned
  // Two sides that cross, or touch where they should not; then there are no loops.
  std::optional<std::array<OutlineSide, 2>> meeting;
};
// Points nearer to a side than `tolerance` lie on it. Without `look_for_meeting` a sound outline is
// taken for granted.
OutlineLoops PartOutline(const std::vector<Eigen::Vector2d>& outline,
                         double tolerance,
                         bool look_for_meeting);

// One outline for each outer loop, its holes joined to it by bridges that cross nothing.
std::vector<std::vector<int>> BridgeHoles(const std::vector<Eigen::Vector2d>& outline,
                                          const OutlineLoops& loops);

}  // namespace groundglass
