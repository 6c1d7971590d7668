// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/check_option.h"

#include "scene/text.h"

#include <cmath>

namespace groundglass {
namespace {

[[noreturn]] void Refuse(const std::string& field, const std::string& rule, double value) {
  throw OptionError(field, "must be " + rule + ", not " + FormatNumber(value));
}

}  // namespace

void CheckFromTo(double value, double least, double most, const std::string& field) {
  if (value >= least && value <= most) return;
  Refuse(field, "from " + FormatNumber(least) + " to " + FormatNumber(most), value);
}

void CheckFinite(double value, const std::string& field) {
  if (!std::isfinite(value)) Refuse(field, "a finite number", value);
}

void CheckAtLeast(double value, double least, const std::string& field) {
  if (std::isinf(value)) CheckFinite(value, field);
  if (value >= least) return;
  Refuse(field, "at least " + FormatNumber(least), value);
}

void CheckAbove(double value, double bound, const std::string& field) {
  if (std::isinf(value)) CheckFinite(value, field);
  if (value > bound) return;
  Refuse(field, "above " + FormatNumber(bound), value);
}

}  // namespace groundglass
