// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"

#include <Eigen/Dense>

#include <array>
#include <optional>
#include <string>

namespace groundglass {

struct FrameOptions {
  // A border is even: so many of the places along the scan's rim differ from their median by no
  // more than this; 8-bit grey levels.
  double even_share = 0.8;
  double even_levels = 14;
  // The picture begins where the grey differs from the border's by this; grey levels.
  double contrast_levels = 20;
  // How far a border may reach into the scan, and how far the picture may be turned.
  double deepest_share = 0.35;
  double most_turn_deg = 8;
  // A side is found if so many of the places along it lie on one line.
  double least_on_line = 0.35;
  // Sides are parallel or at right angles to this, each two of them; degrees.
  double square_deg = 1.0;
  // Width / height of what the mount shows, whichever side is up; outside of these it is no frame.
  double least_aspect = 0.95;
  double most_aspect = 1.75;
  // What is not known of the film behind the opening (36 mm x 24 mm behind 35 mm x 23 mm), of the
  // width, and of the opening's aspect at best, a share; one standard deviation each.
  double mount_play = 0.008;
  double least_aspect_sigma = 0.002;
  // The same of a television frame's aspect where its kind is known: cards differ in where a line
  // begins.
  double video_aspect_share = 0.005;
  // Width / height of a slide that fills a television frame, squeezed.
  double slide_aspect = 1.5;
  // The border's blur, which a crop's mask covers as well; pixels.
  double blur_px = 2;
  // Of what is seen: where one side lies outside of the scan it tells the missing one, and it
  // decides what a television frame holds.
  std::optional<double> aspect;

  void Check() const;  // throws Error naming the first field out of range
};

// The opening of a slide's mount, or the picture within a print's or a glass plate's border, in a
// scan of all of it.
struct SlideFrame {
  bool is_found = false;
  std::string reason;  // if not: one line for a person
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double width_px = 0;
  double height_px = 0;
  double turn_deg = 0;  // clockwise, as the scan is looked at
  double sigma_turn_deg = 0;
  double sigma_px = 0;  // of each side's place, one standard deviation
  std::array<bool, 4> is_side_seen = {false, false, false, false};  // left, top, right, bottom
};

// Finds it by walking in from every side of the scan until the border ends, and fitting a line to
// what lies on one; rounded corners and dark parts of the picture beside the border do not.
SlideFrame FindSlideFrame(const Image8& srgb_grey, const FrameOptions& options = {});

// Width / height of what a digitised television frame holds, with one standard deviation.
struct VideoAspect {
  double aspect = 0;
  double sigma = 0;
};

// What a picture of a television frame's size holds; nothing for other sizes. No size tells a view
// that a television camera took, of 4:3, from a slide of slide_aspect that was squeezed into the
// frame: the mean of both, with half of what is between them as standard deviation, unless
// options.aspect says it. A camera's 4:3 take 710.85 of 720 pixels across 480 or 486 lines, 702 of
// 720 across 576 (ITU-R BT.601: 13.5 MHz; active lines of 52.66 and 52 us); 640 x 480 and 768 x 576
// have square pixels.
std::optional<VideoAspect> FindVideoAspect(int width_px,
                                           int height_px,
                                           const FrameOptions& options = {});

}  // namespace groundglass
