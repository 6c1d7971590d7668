// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"
#include "scene/polygon_model.h"

#include <cstdint>

namespace groundglass {

// A house of 40 x 20 x 24 ft with a gable roof, a chimney and a lean-to: no symmetry that a
// registration could fall for.
PolygonModel MakeHouse();

// Pixels of its photographs; the small ones are for what does not look at them closely.
inline constexpr int kPhotoWidth = 600;
inline constexpr int kPhotoHeight = 400;
inline constexpr int kSmallWidth = 300;
inline constexpr int kSmallHeight = 200;

// A photograph of the model, drawn by casting rays: each face in a grey of its own on a light sky,
// averaged over 3 x 3 rays a pixel, with normal noise of this many grey levels.
Image8 PhotographModel(const PolygonModel& model,
                       const Camera& camera,
                       double noise_levels,
                       uint64_t seed);

// The mean distance, px, between the model's points as two cameras project them, over those inside
// the first one's frame.
double VertexErrorPx(const PolygonModel& model, const Camera& truth, const Camera& found);

}  // namespace groundglass
