// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/image.h"
#include "scene/polygon_model.h"
#include "scene/visibility.h"

namespace groundglass {

// Which face each pixel's centre shows, from 1; 0: none, or a face's back. The same answer as
// Visibility::FaceLabels; rays are spent along the model's projected edges only, since nowhere
// else can the answer change.
Image16 MakeFaceMask(const PolygonModel& model, const Visibility& visibility, const Camera& camera);

}  // namespace groundglass
