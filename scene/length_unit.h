// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace groundglass {

// The unit of a model's lengths.
enum class LengthUnit { kFoot, kMetre, kMillimetre, kCentimetre, kInch, kUsSurveyFoot };

double MetresPerUnit(LengthUnit unit);

// "ft", "m", "mm", "cm", "in", "us-ft": in files, options and messages.
std::string UnitName(LengthUnit unit);
// The unit of such a name, whatever its case; nothing if there is none.
std::optional<LengthUnit> FindUnit(std::string_view name);
// "ft, m, mm, cm, in or us-ft", for messages.
std::string UnitNames();

}  // namespace groundglass
