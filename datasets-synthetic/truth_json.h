// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "datasets-synthetic/planned_scene.h"
#include "datasets-synthetic/vertex_error.h"
#include "scene/polygon_model.h"

#include <string>
#include <vector>

namespace groundglass {

// How far the hand tag throws the model's points off, in the picture as written.
VertexError MeasureTagError(const PolygonModel& model, const PhotographPlan& plan);

// What is added to the occluders' codes in masks: models of 250 faces and more need them elsewhere.
int OccluderCodeOffset(const PolygonModel& model);

// truth.json, laid out as in the brick scene.
std::string FormatTruth(const SynthRecipe& recipe, const PlannedScene& planned);

}  // namespace groundglass
