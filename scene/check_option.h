// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>

namespace groundglass {

// What the Check() of an options struct asks of its fields. Each throws an Error of one line that
// starts with the field's name, says what it must be, and what it is; not a number is never right.
// field: with its structs before it, "registration options: hypotheses.max_starts".

void CheckFromTo(double value, double least, double most, const std::string& field);
void CheckFinite(double value, const std::string& field);
void CheckAtLeast(double value, double least, const std::string& field);  // and finite
void CheckAbove(double value, double bound, const std::string& field);    // and finite

}  // namespace groundglass
