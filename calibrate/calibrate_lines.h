// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/known_keys.h"
#include "scene/image.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace groundglass {

struct LinesOptions {
  // What is known of any camera, one standard deviation: the principal point's place on each side
  // of the picture's middle (share of its width; a slide's mount included) and k1.
  double center_sigma = 0.015;
  double k1_sigma = 0.1;

  // Segments shorter than this share of the width are not looked at.
  double shortest_share = 0.025;
  // A direction counts if so many segments follow it, and a camera if so many do in all.
  int min_segments_of_direction = 8;
  int min_segments = 20;
  // Segments' own standard deviations count so many times; what lines that lie together have in
  // common is measured besides.
  double inflation = 1.3;
  // A view angle is told if it is known to this share.
  double worst_view_angle_share = 0.12;
  // A camera of quite another view angle whose cost is not larger by this share leaves the first
  // undecided.
  double rival_share = 0.15;
  // Width / height of the whole picture, where its pixels are not square, as those of digitised
  // video are not.
  std::optional<double> aspect;
  // Its standard deviation; lines do not find it out, and nothing is told if it is more than this
  // share of the aspect.
  double aspect_sigma = 0;
  double worst_aspect_share = 0.02;

  void Check() const;  // throws Error naming the first field out of range
};

// What the lines of a building say of the camera.
struct LinesResult {
  bool is_found = false;
  std::string reason;  // if not: one line for a person
  // In the tag's units, with one standard deviation each.
  double view_angle_deg = 0, sigma_view_angle_deg = 0;
  double shift_x = 0, sigma_shift_x = 0;
  double shift_y = 0, sigma_shift_y = 0;
  double roll_deg = 0, sigma_roll_deg = 0;
  double pitch_deg = 0, sigma_pitch_deg = 0;  // of the view axis, up positive
  double k1 = 0, sigma_k1 = 0;
  int num_segments = 0;                             // that follow one of the three directions
  std::array<int, 3> num_of_direction = {0, 0, 0};  // two level ones, the vertical
  double rms_px = 0;                                // of their ends
};

// Finds view angle, principal point, roll and k1 of one photograph of a building from its parallel
// and straight lines: three perpendicular directions, whose vanishing points and curvature are
// fitted to every segment at once. Pixels are square unless options.aspect says otherwise. Not
// found where the lines leave it open, as those of one wall seen from straight in front do.
LinesResult CalibrateLines(const Image8& srgb_grey,
                           const LinesOptions& options = {},
                           uint64_t seed = 1988);

// The numbers that the lines tell better than the options did before, as keys of a view file.
KnownKeys KeysOfLines(const LinesResult& result, const LinesOptions& options);

}  // namespace groundglass
