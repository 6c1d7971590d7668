// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/length_unit.h"

#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace groundglass {
namespace {

struct NamedUnit {
  LengthUnit unit;
  const char* name;
  double metres;
  // As people and programs write it in full, in the singular and the plural.
  std::array<const char*, 4> words;
};
constexpr std::array<NamedUnit, 6> kUnits = {{
    {LengthUnit::kFoot, "ft", kMetresPerFoot, {"foot", "feet", "foot", "feet"}},
    {LengthUnit::kMetre, "m", 1, {"metre", "metres", "meter", "meters"}},
    {LengthUnit::kMillimetre,
     "mm",
     1e-3,
     {"millimetre", "millimetres", "millimeter", "millimeters"}},
    {LengthUnit::kCentimetre,
     "cm",
     1e-2,
     {"centimetre", "centimetres", "centimeter", "centimeters"}},
    {LengthUnit::kInch, "in", 0.0254, {"inch", "inches", "inch", "inches"}},
    {LengthUnit::kUsSurveyFoot,
     "us-ft",
     1200.0 / 3937.0,
     {"us survey foot", "us survey feet", "survey foot", "survey feet"}},
}};

const NamedUnit& Find(LengthUnit unit) {
  for (const NamedUnit& named : kUnits) {
    if (named.unit == unit) return named;
  }
  return kUnits.front();
}

}  // namespace

double MetresPerUnit(LengthUnit unit) { return Find(unit).metres; }

std::string UnitName(LengthUnit unit) { return Find(unit).name; }

std::optional<LengthUnit> FindUnit(std::string_view name) {
  const std::string lower = LowerCase(name);
  for (const NamedUnit& named : kUnits) {
    const bool is_in_full =
        std::find(named.words.begin(), named.words.end(), lower) != named.words.end();
    if (lower == named.name || is_in_full) return named.unit;
  }
  return std::nullopt;
}

std::string UnitNames() {
  std::string names;
  for (size_t i = 0; i < kUnits.size(); ++i) {
    names += i == 0 ? "" : i + 1 == kUnits.size() ? " or " : ", ";
    names += kUnits[i].name;
  }
  return names;
}

}  // namespace groundglass
