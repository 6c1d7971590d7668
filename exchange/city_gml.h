// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/model_io.h"

#include <filesystem>

namespace groundglass {

// A CityGML model (OGC 12-019): of each object of the city the polygons of its finest level of
// detail, with their holes, named after themselves or what they are part of; metres, x east, y
// north, z up, as precise as the file has them. Pictures are not read. Throws Error naming file and
// line.
ModelReading ReadCityGml(const std::filesystem::path& file);

}  // namespace groundglass
