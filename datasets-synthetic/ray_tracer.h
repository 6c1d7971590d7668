// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/daylight.h"
#include "datasets-synthetic/synthetic_world.h"
#include "scene/camera.h"
#include "scene/image.h"
#include "scene/visibility.h"

namespace groundglass {

// What is drawn: a world, its rays, and its light. The sky map may be of a world without the last
// faces (things that stand about in one photograph only).
struct RayScene {
  const SyntheticWorld& world;
  const Visibility& visibility;
  const SkyMap& sky_map;
  Daylight light;
  int rays_per_edge_pixel = 16;  // a square number
};

// The picture that a camera takes, in linear light, each pixel the mean over its area: textures are
// filtered over its footprint; where faces or shadows meet, jittered rays share the pixel.
// The same bytes whatever the number of threads.
ImageF RenderRadiance(const RayScene& scene, const Camera& camera, uint64_t seed);

}  // namespace groundglass
