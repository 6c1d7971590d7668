// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts/charts.h"
#include "invrender/inputs/detail_options.h"
#include "invrender/measure/patch.h"
#include "invrender/photos/prepared_photo.h"
#include "scene/polygon_model.h"

#include <vector>

namespace groundglass {

// Patches spread over all faces, where two photographs or more show them whole and clear of
// borders. Goes photograph by photograph, so that each is decoded once.
std::vector<Patch> SamplePatches(const PolygonModel& model,
                                 const std::vector<Chart>& charts,
                                 const std::vector<PreparedPhoto>& photos,
                                 const PatchOptions& options);

}  // namespace groundglass
