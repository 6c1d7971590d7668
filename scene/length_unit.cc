// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/length_unit.h"

#include "scene/frames.h"
#include "scene/text.h"

#include <array>

namespace groundglass {
namespace {

struct NamedUnit {
  LengthUnit unit;
  const char* name;
  double metres;
};
constexpr std::array<NamedUnit, 6> kUnits = {{
    {LengthUnit::kFoot, "ft", kMetresPerFoot},
    {LengthUnit::kMetre, "m", 1},
    {LengthUnit::kMillimetre, "mm", 1e-3},
    {LengthUnit::kCentimetre, "cm", 1e-2},
    {LengthUnit::kInch, "in", 0.0254},
    {LengthUnit::kUsSurveyFoot, "us-ft", 1200.0 / 3937.0},
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
    if (lower == named.name) return named.unit;
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
