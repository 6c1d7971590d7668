// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What to write in place of what people, spreadsheets and other programs write for a number.
#include "scene/length_unit.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {
namespace {

// 5O and 3l, as they are typed for 50 and 31; empty if there is no such letter beside digits.
std::string WithDigitsForLetters(std::string_view word) {
  std::string digits(word);
  std::replace(digits.begin(), digits.end(), 'O', '0');
  std::replace(digits.begin(), digits.end(), 'o', '0');
  std::replace(digits.begin(), digits.end(), 'l', '1');
  std::replace(digits.begin(), digits.end(), 'I', '1');
  const bool has_digit = word.find_first_of("0123456789") != std::string_view::npos;
  return has_digit && digits != word ? digits : "";
}

// What follows a number as its unit: letters, a degree sign, the marks for feet and inches.
bool IsUnitSign(std::string_view word) {
  constexpr std::array<std::string_view, 9> kSigns = {
      "\u00B0", "'", "\"", "\u2032", "\u2033", "?", "(?)", "*", "!"};
  if (std::isalpha(static_cast<unsigned char>(word[0])) != 0) return word[0] != 'x';
  return std::find(kSigns.begin(), kSigns.end(), word) != kSigns.end();
}

std::string_view WithoutBlanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

// A number with what people write before or after it: "ca. 3.2", "9.7 m".
struct NumberAmongWords {
  std::string_view number;
  std::string_view other;  // empty: there is nothing but the number, or no number
};

NumberAmongWords FindNumber(std::string_view text) {
  const size_t end = text.find_first_not_of("+-.0123456789");
  if (end != std::string_view::npos && end > 0 && ParseNumber(text.substr(0, end))) {
    const std::string_view unit = WithoutBlanks(text.substr(end));
    return !unit.empty() && IsUnitSign(unit) ? NumberAmongWords{text.substr(0, end), unit}
                                             : NumberAmongWords{};
  }
  // The full stop of "ca." begins no number.
  const size_t begin = text.find_first_of("+-0123456789");
  if (begin == std::string_view::npos || begin == 0) return {};
  const std::string_view number = text.substr(begin);
  const std::string_view before = WithoutBlanks(text.substr(0, begin));
  return ParseNumber(number) && !before.empty() ? NumberAmongWords{number, before}
                                                : NumberAmongWords{};
}

// Feet and inches, or degrees, minutes and seconds: the parts, each with its mark.
struct MarkedNumber {
  bool is_feet = false;
  double value = 0;
};

// 22'-2.4", 6' 3", 6", 54\u00B030', 54\u00B030'15".
std::optional<MarkedNumber> FindMarkedNumber(std::string_view text) {
  struct Mark {
    std::string_view sign;
    char kind;
  };
  constexpr std::array<Mark, 6> kMarks = {{{"\u00B0", 'd'},
                                           {"'", 'm'},
                                           {"\u2032", 'm'},
                                           {"\u2019", 'm'},
                                           {"\"", 's'},
                                           {"\u2033", 's'}}};
  std::string kinds;
  std::vector<double> parts;
  const bool is_negative = text.starts_with('-');
  if (is_negative) text.remove_prefix(1);
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
    const std::optional<double> number = ParseNumber(text.substr(0, end));
    if (!number) return std::nullopt;
    text = WithoutBlanks(text.substr(end));
    const auto mark = std::find_if(
        kMarks.begin(), kMarks.end(), [&](const Mark& one) { return text.starts_with(one.sign); });
    // The last mark is often left away.
    if (mark == kMarks.end() && (!text.empty() || kinds.empty())) return std::nullopt;
    const char kind = mark == kMarks.end() ? (kinds.back() == 'd' ? 'm' : 's') : mark->kind;
    if (mark != kMarks.end()) text = WithoutBlanks(text.substr(mark->sign.size()));
    if (text.starts_with('-')) text = WithoutBlanks(text.substr(1));
    kinds += kind;
    parts.push_back(*number);
  }
  MarkedNumber marked;
  if (kinds == "ms" || kinds == "s") {
    marked.is_feet = true;
    marked.value = parts.back() / 12 + (kinds == "ms" ? parts[0] : 0);
  } else if (kinds == "dm" || kinds == "dms") {
    marked.value = parts[0] + parts[1] / 60 + (kinds == "dms" ? parts[2] / 3600 : 0);
  } else {
    return std::nullopt;
  }
  if (is_negative) marked.value = -marked.value;
  return marked;
}

// 1,022.2 or 1.022,2: thousands that are parted, without what parts them; empty for others.
std::string WithoutThousands(std::string_view word) {
  const size_t comma = word.find(',');
  const size_t point = word.find('.');
  if (comma == std::string_view::npos || point == std::string_view::npos) return "";
  const char parting = comma < point ? ',' : '.';
  const size_t decimals = word.find(parting == ',' ? '.' : ',');
  std::string plain;
  size_t group = 0;
  bool is_first = true;
  for (const char c : word.substr(0, decimals)) {
    if (c != parting) {
      plain += c;
      ++group;
      continue;
    }
    if (group == 0 || group > 3 || (!is_first && group != 3)) return "";
    is_first = false;
    group = 0;
  }
  if (group != 3) return "";
  plain += "." + std::string(word.substr(decimals + 1));
  return ParseNumber(plain) ? plain : "";
}

// A cell in which a spreadsheet left something other than its value.
std::string WhatASpreadsheetLeft(std::string_view word) {
  if (word.starts_with("#") && word.size() > 2 && std::isupper(word[1]) != 0) {
    return "a spreadsheet's error: look up what was written";
  }
  if (word.starts_with("=")) return "a spreadsheet's formula: save the table with its values";
  return "";
}

// Jan, January, janvier: what begins as months do in the languages of most spreadsheets.
bool IsMonth(std::string_view word) {
  constexpr std::array<std::string_view, 16> kMonths = {"jan",
                                                        "feb",
                                                        "mar",
                                                        "apr",
                                                        "may",
                                                        "mai",
                                                        "jun",
                                                        "jul",
                                                        "aug",
                                                        "sep",
                                                        "oct",
                                                        "okt",
                                                        "nov",
                                                        "dec",
                                                        "dez",
                                                        "dic"};
  std::string start(word.substr(0, 3));
  std::transform(start.begin(), start.end(), start.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return std::find(kMonths.begin(), kMonths.end(), start) != kMonths.end();
}

}  // namespace

std::string WhyNoNumber(std::string_view word) { return WhyNoNumber(word, '.'); }

std::string WhyNoNumber(std::string_view word, char decimal_mark) {
  if (ParseNumber(word)) return Quote(word) + " is not a finite number";
  std::string fault = Quote(word) + " is not a number";
  const auto written = [&](std::string_view number) {
    std::string text(number);
    std::replace(text.begin(), text.end(), '.', decimal_mark);
    return text;
  };
  if (const std::string left = WhatASpreadsheetLeft(word); !left.empty()) {
    return fault + "; " + left;
  }
  if (const std::string plain = WithoutThousands(word); !plain.empty()) {
    return fault + "; write " + written(plain);
  }
  std::string with_points(word);
  std::replace(with_points.begin(), with_points.end(), ',', '.');
  if (with_points != word && ParseNumber(with_points) && decimal_mark == '.') {
    return fault + "; write " + with_points + ", with a point";
  }
  const std::string_view plain = with_points;
  // The minus sign, the hyphen and the dashes that word processors put in place of `-`.
  for (const std::string_view dash : {"\u2212", "\u2010", "\u2011", "\u2012", "\u2013", "\u2014"}) {
    if (!plain.starts_with(dash)) continue;
    const std::string with_minus = "-" + std::string(plain.substr(dash.size()));
    if (ParseNumber(with_minus)) {
      return fault + ", for its minus is a dash; write " + written(with_minus);
    }
  }
  if (const std::string digits = WithDigitsForLetters(plain); ParseNumber(digits)) {
    return fault + "; is it " + written(digits) + ", with a letter in place of a digit?";
  }
  // 1.4D+01, as programs in Fortran write it.
  if (const size_t exponent = plain.find_first_of("dD");
      exponent != std::string_view::npos && exponent > 0) {
    std::string with_e(plain);
    with_e[exponent] = 'E';
    if (ParseNumber(with_e)) return fault + "; write " + written(with_e);
  }
  const auto rounded = [&](double value) {
    return written(FormatNumber(std::round(1e4 * value) / 1e4));
  };
  for (const std::string_view sign : {"\u00B1", "+/-", "+-"}) {
    const size_t at = plain.find(sign);
    if (at == std::string_view::npos) continue;
    const std::string_view number = WithoutBlanks(plain.substr(0, at));
    if (!ParseNumber(number) || !ParseNumber(WithoutBlanks(plain.substr(at + sign.size())))) break;
    return fault + "; write " + written(number) +
           " alone, and how sure it is under sigma_position, sigma_lookat and the like";
  }
  if (const std::optional<MarkedNumber> marked = FindMarkedNumber(plain)) {
    return fault +
           (marked->is_feet
                ? "; feet and inches are written with decimals: " + rounded(marked->value) + " ft"
                : "; write " + rounded(marked->value));
  }
  const size_t times = plain.find("\u00D7");
  const size_t middle = times != std::string_view::npos ? times : plain.find_first_of(":/x");
  const size_t width = times != std::string_view::npos ? 2 : 1;
  if (middle != std::string_view::npos) {
    const std::optional<double> above = ParseNumber(WithoutBlanks(plain.substr(0, middle)));
    const std::optional<double> below = ParseNumber(WithoutBlanks(plain.substr(middle + width)));
    if (above && below && *above != 0 && *below != 0 && std::isfinite(*above / *below)) {
      return fault + "; write " + rounded(*above / *below);
    }
  }
  if (const NumberAmongWords found = FindNumber(plain); !found.other.empty()) {
    if (found.other.starts_with("'") || found.other.starts_with("\u2032")) {
      return fault + "; write feet with decimals: 3' 6\" is " + written("3.5");
    }
    if (IsMonth(found.other)) {
      return fault + "; a spreadsheet has made a date of it: look up what was written";
    }
    // The number alone would be taken for one of the model's unit.
    if (const std::optional<LengthUnit> unit = FindUnit(found.other)) {
      return fault + "; write " + written(found.number) + " alone, if the model is in " +
             UnitName(*unit) + " too, or else what that is in its unit";
    }
    return fault + "; write " + written(found.number) + " alone, without " + Quote(found.other);
  }
  return fault;
}

}  // namespace groundglass
