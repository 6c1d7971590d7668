// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/textured_model.h"

#include <Eigen/Dense>

namespace groundglass {

// A page of one-texel squares, black and white, the top-left one white.
Image8 MakeCheckerPage(int width, int height);
Image8 MakePlainPage(int width, int height, uint8_t red, uint8_t green, uint8_t blue);

// A wall in the plane Y = 0 with its front to the south (-Y): X from 0 to `width`, Z from 0 to
// `height`, the whole page on it, top up.
TexturedModel MakeWall(double width, double height, const Image8& page_srgb8);

// A box of 4 x 3 x 2 around the origin, each face with the same checkered page of 64 texels.
TexturedModel MakeCheckeredBox();

// Looks from `position` at `target`, no roll; square pixels, principal point in the middle.
Camera MakeCamera(const Eigen::Vector3d& position_in_world,
                  const Eigen::Vector3d& target_in_world,
                  int width_px,
                  int height_px,
                  double focal_px);

}  // namespace groundglass
