// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/inputs/photo_options.h"
#include "scene/camera.h"
#include "scene/image.h"
#include "scene/polygon_model.h"

#include <vector>

namespace groundglass {

constexpr double kBorderStepsPerPx = 8;
// Distances end here (steps).
constexpr int kFarthestBorder = 230;

// For each pixel the distance (eighths of a pixel, at most kFarthestBorder) from its centre to the
// nearest border of the face mask where another chart begins, and to the nearest ignored pixel
// (non-zero in `ignored`, which may be empty); ignored pixels and those without a face are 0.
Image8 ComputeBorderDistance(const PolygonModel& model,
                             const Camera& camera,
                             const Image16& labels,
                             const std::vector<int>& chart_of_face,
                             const Image8& ignored,
                             const BorderOptions& options = {});

// Pixels (255) that belong to the black mount of a slide: dark, connected to a side of the frame
// that is dark along most of its length, and not far in. Widened by a few pixels, where the mount's
// edge is blurred.
Image8 FindMount(const Image8& srgb8, const MountOptions& options = {});
Image8 FindMount(const Image16& srgb16, const MountOptions& options = {});

}  // namespace groundglass
