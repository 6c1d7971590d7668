// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/error.h"

#include <string>

namespace groundglass {

// A field of an options struct that is out of its range. It is an Error like any other; a program
// whose options fill the struct can tell which of them was at fault, and name it in place of the
// field.
class OptionError : public Error {
 public:
  // what() is both in one line: "bake options: gutter_texels must be from 1 to 24, not 25".
  // field: with its structs before it; rule: what it must be and what it is.
  OptionError(const std::string& field, const std::string& rule)
      : Error(field + " " + rule), field_(field), rule_(rule) {}
  const std::string& field() const { return field_; }
  const std::string& rule() const { return rule_; }

 private:
  std::string field_;
  std::string rule_;
};

// What the Check() of an options struct asks of its fields. Each throws an OptionError of one line
// that starts with the field's name, says what it must be, and what it is; not a number is never
// right. field: with its structs before it, "registration options: hypotheses.max_starts".

void CheckFromTo(double value, double least, double most, const std::string& field);
void CheckFinite(double value, const std::string& field);
void CheckAtLeast(double value, double least, const std::string& field);  // and finite
void CheckAbove(double value, double bound, const std::string& field);    // and finite

}  // namespace groundglass
