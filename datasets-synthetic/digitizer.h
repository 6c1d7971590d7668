// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/slide.h"
#include "scene/image.h"

#include <cstdint>

namespace groundglass {

// The mount's opening, which reaches this far beyond the ideal frame on every side (pixels of the
// scan); a slide that lies out of register shows the mount's black rim.
struct MountOpening {
  double margin_px = 0;
};
// How far inside the opening a scan's point lies, in pixels of the ideal picture; negative under
// the mount. The opening's corners are a little round.
double DepthInOpening(const MountOpening& opening,
                      const SlideTransform& slide,
                      const Eigen::Vector2d& scan_px,
                      int width_px,
                      int height_px);
// Pictures here are encoded sRGB in [0, 1], 3 channels, as DevelopPhotograph gives them.
void DrawMount(const MountOpening& opening, const SlideTransform& slide, ImageF& scan);

// Specks and hairs on the slide (dark), and scratches in its emulsion (light).
void DrawDust(int num_specks, int num_scratches, uint64_t seed, ImageF& scan);

// The scan as an NTSC frame of 640 x 480 digitised from video, as the thesis' slides were: not
// square pixels, chroma of little bandwidth, fields half a line's time apart, noise. The whole scan
// fills the frame.
ImageF NtscFromScan(const ImageF& scan, uint64_t seed);

}  // namespace groundglass
