// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace groundglass {

// ViSP's model-based edge tracker on one picture, in plain types: ViSP's headers are C++17, the
// rest of the tree is C++20.
struct VispTracking {
  std::string cao_file;
  int width_px = 0;
  int height_px = 0;
  const uint8_t* grey8 = nullptr;
  double focal_x_px = 1;
  double focal_y_px = 1;
  double center_x_px = 0;  // pixel centres at whole numbers, as ViSP counts
  double center_y_px = 0;
  double edge_threshold = 10000;
  bool with_scan_lines = false;  // hidden lines by scan lines, not by the faces' angles alone
  std::vector<int> ranges_px;    // search ranges, in turn
  int repeats = 1;               // how often the picture is tracked with each
};

// Rows of [R t], metres. Returns the start's where the tracker says at once that it is lost.
using VispPose = std::array<double, 12>;
VispPose TrackWithVisp(const VispTracking& tracking, const VispPose& start);

}  // namespace groundglass
