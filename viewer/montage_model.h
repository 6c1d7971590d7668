// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to viewer.
#pragma once

#include "scene/camera.h"
#include "scene/textured_model.h"
#include "scene/visibility.h"
#include "viewer/montage_light.h"

#include <vector>

namespace groundglass {

// Whether each of the design's faces lies on the building's wherever it is looked at: the building
// as it stands, drawn again. tolerance: model's unit.
std::vector<bool> FindRepeatedFaces(const PolygonModel& design,
                                    const Visibility& building,
                                    double tolerance);

// These faces of the design alone, turned to the camera. Those without a texture are grey;
// plain_albedo: linear light.
TexturedModel DesignToDraw(const TexturedModel& design,
                           const std::vector<int>& faces,
                           const Camera& camera,
                           double plain_albedo);

// The same faces, each in one grey or colour: the light on it over `scale`, which makes the
// brightest white.
TexturedModel LightToDraw(const TexturedModel& design_to_draw,
                          const MontageLight& light,
                          double scale);
// The most light in any channel that any of the faces gets.
double BrightestLight(const TexturedModel& design_to_draw, const MontageLight& light);

// Puts the building beside it, not to be drawn but to hide (kHidingPage). It is moved away from
// the camera by `farther`, the model's unit, along the lines of sight: it looks the same, and what
// lies on it is in front of it.
TexturedModel HiddenByBuilding(TexturedModel to_draw,
                               const PolygonModel& building,
                               const Camera& camera,
                               double farther);

}  // namespace groundglass
