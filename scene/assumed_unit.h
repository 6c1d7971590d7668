// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/polygon_model.h"

#include <filesystem>
#include <optional>
#include <string>

namespace groundglass {

// A unit that is only assumed: how a summary names it, after the unit.
inline constexpr const char* kAssumedUnit = "ASSUMED: neither the file nor --unit says it";
// The same as a warning, where no summary tells it; nothing if the unit is known.
inline std::optional<std::string> DescribeAssumedUnit(const std::filesystem::path& file,
                                                      const PolygonModel& model) {
  if (!model.is_unit_assumed) return std::nullopt;
  return file.string() + ": the unit, " + UnitName(model.unit) + ", is " + kAssumedUnit;
}

}  // namespace groundglass
