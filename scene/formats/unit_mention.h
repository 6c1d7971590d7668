// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/polygon_model.h"
#include "scene/text.h"

#include <filesystem>
#include <string>
#include <vector>

namespace groundglass {

// A warning of what the comments above a model's first word say of its unit in words that are not
// read ("% units = metres"); empty if they say nothing, or nothing else than what is assumed.
std::string UnitNotRead(const std::filesystem::path& name,
                        const std::vector<TextLine>& lines,
                        const PolygonModel& model);

}  // namespace groundglass
