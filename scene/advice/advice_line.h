// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/length_unit.h"

#include <string>

namespace groundglass {

// Something about a scene that can be read but cannot well be meant, and what to do about it.
struct Advice {
  // kScene: what is odd concerns every photograph, so that nothing will fit before it is mended.
  enum class Severity { kScene, kDetail };
  Severity severity = Severity::kDetail;
  std::string subject;  // the file that it is about
  std::string message;  // what is odd, in numbers
  std::string remedy;   // what to do, an option or a command where there is one
};

// "SUBJECT: MESSAGE; REMEDY", one line.
std::string FormatAdvice(const Advice& advice);
// A length in the model's unit and in metres: "12.3 ft (3.75 m)".
std::string FormatLength(double length, LengthUnit unit);

}  // namespace groundglass
