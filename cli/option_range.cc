// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/option_range.h"

#include "scene/text.h"

#include <cmath>
#include <optional>
#include <string>

namespace groundglass {
namespace {

template <typename IsRight>
CLI::Validator NumberThatIs(const std::string& rule, const IsRight& is_right) {
  return CLI::Validator(
      [=](const std::string& word) {
        const std::optional<double> number = ParseNumber(word);
        if (!number) return "must be a number, " + rule + ", not " + Quote(word);
        if (std::isfinite(*number) && is_right(*number)) return std::string();
        return "must be " + rule + ", not " + word;
      },
      rule);
}

}  // namespace

CLI::Validator AtLeast(double least) {
  return NumberThatIs("at least " + FormatNumber(least),
                      [=](double number) { return number >= least; });
}

CLI::Validator Above(double bound) {
  return NumberThatIs("above " + FormatNumber(bound),
                      [=](double number) { return number > bound; });
}

CLI::Validator FromTo(double least, double most) {
  return NumberThatIs("from " + FormatNumber(least) + " to " + FormatNumber(most),
                      [=](double number) { return number >= least && number <= most; });
}

}  // namespace groundglass
