// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"
#include "scene/polygon_model.h"

namespace groundglass {

// A wall 40 ft wide and 20 high in the plane y = 0 that faces south, and the ground before it.
PolygonModel MakeWall();

// A camera some way south of it, `x` ft east of the wall's west end.
Camera CameraBeforeWall(double x, double distance, double lookat_x);

// How light the plaster is at a place of its plane: blotches of all sizes, nothing repeated, in
// [0, 1].
float PlasterLight(double x, double z);

// A photograph of the plaster, wherever it is, as if its plane lay `recess` ft further north.
Image8 PhotographPlaster(const Camera& camera, double recess);

}  // namespace groundglass
