// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"
#include "scene/polygon_model.h"

#include <vector>

namespace groundglass {

// Borders between faces that meet there mix two colours in one pixel; borders where the farther
// surface is hidden are worse, since an error of the camera moves one over the other. The first
// kind counts as this much farther away.
constexpr double kCreaseBonusPx = 1.5;
constexpr double kBorderStepsPerPx = 8;
// Distances end here (steps).
constexpr int kFarthestBorder = 230;

// For each pixel the distance (eighths of a pixel, at most kFarthestBorder) from its centre to the
// nearest border of the face mask where another chart begins, and to the nearest ignored pixel
// (non-zero in `ignored`, which may be empty); ignored pixels and those without a face are 0.
// crease_bonus_px: kCreaseBonusPx in the mask's pixels, where these are longer than the
// photograph's.
Image8 ComputeBorderDistance(const PolygonModel& model,
                             const Camera& camera,
                             const Image16& labels,
                             const std::vector<int>& chart_of_face,
                             const Image8& ignored,
                             double crease_bonus_px = kCreaseBonusPx);

// Pixels (255) that belong to the black mount of a slide: dark, connected to a side of the frame
// that is dark along most of its length, and no farther in than a tenth of the frame. Widened by
// a few pixels, where the mount's edge is blurred.
Image8 FindMount(const Image8& srgb8);
Image8 FindMount(const Image16& srgb16);

}  // namespace groundglass
