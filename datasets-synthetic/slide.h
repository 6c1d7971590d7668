// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"

#include <array>
#include <cstdint>

namespace groundglass {

// What mount and scanner do to a picture, about the frame's centre, pixels of the scan:
//   scan = centre + shift + diag(scale (1 + aniso / 2), scale (1 - aniso / 2)) Rot(turn) (ideal -
//   centre)
// turn is clockwise as the picture is looked at. The scanner stretches after the mount has turned,
// so a pinhole's scan is a pinhole's picture again, without skew.
struct SlideTransform {
  double shift_x_px = 0;
  double shift_y_px = 0;
  double turn_deg = 0;
  double scale = 1;
  double anisotropy = 0;

  // Where an ideal image point comes to lie in the scan of a width x height picture.
  Eigen::Vector2d ScanFromIdeal(const Eigen::Vector2d& ideal_px, int width_px, int height_px) const;
};

// The camera that takes the scan directly: what truth is. The ideal camera's pixels must be square
// and its principal point central.
Camera FoldInSlide(const Camera& ideal, const SlideTransform& slide);

// How film and lab rendered the light.
struct Photometry {
  double exposure_stops = 0;
  std::array<double, 3> white_balance = {1, 1, 1};
  double vignetting = 0;  // 1: light falls off as the fourth power of the cosine
  double grain = 0;       // standard deviation of the encoded value at mid grey, of [0, 1]
  double blur_px = 0;     // of lens and film, one standard deviation
  // The camera was shaken: every point travels this far, half of it before the middle of the
  // exposure, at this angle clockwise from the picture's x axis.
  double motion_px = 0;
  double motion_deg = 0;
  double defocus_px = 0;  // radius of the disc that a point out of focus becomes
};

// The developed and scanned picture from its radiance: encoded sRGB in [0, 1], 3 channels.
// Vignetting is about the scan's centre. Works in the radiance's own memory: move it in.
ImageF DevelopPhotograph(ImageF radiance,
                         const Camera& camera,
                         const Photometry& photometry,
                         uint64_t seed);

// Encoded values to 8-bit codes.
Image8 QuantiseSrgb8(const ImageF& encoded);

}  // namespace groundglass
