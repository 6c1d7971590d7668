// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/camera.h"
#include "scene/polygon_model.h"

#include <filesystem>
#include <string>

namespace groundglass {

// Why a view's picture shows nothing of the model; empty if it shows some.
std::string WhyNothingIsDrawn(const PolygonModel& model,
                              const Camera& camera,
                              const std::filesystem::path& view_file);

}  // namespace groundglass
