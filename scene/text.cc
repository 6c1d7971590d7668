// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace groundglass {
namespace {

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }

}  // namespace

std::string_view TrimBlanks(std::string_view text) {
  while (!text.empty() && IsBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::vector<TextLine> SplitLines(std::string_view text, char comment_mark) {
  std::vector<TextLine> lines;
  size_t begin = text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
  while (begin < text.size()) {
    TextLine& line = lines.emplace_back();
    line.number = static_cast<int>(lines.size());
    line.offset = begin;
    const size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    line.size = end - begin;
    size_t at = begin;
    while (at < end) {
      if (IsBlank(text[at])) {
        ++at;
        continue;
      }
      if (text[at] == comment_mark) {
        line.has_comment = true;
        line.comment = TrimBlanks(text.substr(at + 1, end - at - 1));
        break;
      }
      size_t word_end = at;
      while (word_end < end && !IsBlank(text[word_end]) && text[word_end] != comment_mark) {
        ++word_end;
      }
      line.tokens.push_back({text.substr(at, word_end - at), at, line.number});
      at = word_end;
    }
    begin = end;
    if (begin < text.size()) {
      begin += text.substr(begin, 2) == "\r\n" ? 2 : 1;
    }
  }
  return lines;
}

std::optional<double> ParseNumber(std::string_view word) {
  if (!word.empty() && word.front() == '+') {
    word.remove_prefix(1);
    if (!word.empty() && (word.front() == '-' || word.front() == '+')) return std::nullopt;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Too small to hold is zero; too large is infinite.
    const size_t exponent = word.find_first_of("eE");
    const bool is_tiny = exponent != std::string_view::npos && exponent + 1 < word.size() &&
                         word[exponent + 1] == '-';
    return is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  if (error != std::errc()) return std::nullopt;
  return value;
}

std::optional<long long> ParseInteger(std::string_view word) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  long long value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    return word.front() == '-' ? std::numeric_limits<long long>::min()
                               : std::numeric_limits<long long>::max();
  }
  if (error != std::errc()) return std::nullopt;
  return value;
}

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
  constexpr std::array<std::string_view, 5> kSigns = {"\u00B0", "'", "\"", "\u2032", "\u2033"};
  if (std::isalpha(static_cast<unsigned char>(word[0])) != 0) return word[0] != 'x';
  return std::find(kSigns.begin(), kSigns.end(), word) != kSigns.end();
}

}  // namespace

namespace {

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
  const size_t middle = plain.find_first_of(":/");
  if (middle != std::string_view::npos) {
    const std::optional<double> above = ParseNumber(WithoutBlanks(plain.substr(0, middle)));
    const std::optional<double> below = ParseNumber(WithoutBlanks(plain.substr(middle + 1)));
    if (above && below && *below != 0 && std::isfinite(*above / *below)) {
      return fault + "; write " + written(FormatNumber(std::round(1e4 * *above / *below) / 1e4));
    }
  }
  if (const NumberAmongWords found = FindNumber(plain); !found.other.empty()) {
    if (found.other.starts_with("'") || found.other.starts_with("\u2032")) {
      return fault + "; write feet with decimals: 3' 6\" is " + written("3.5");
    }
    if (IsMonth(found.other)) {
      return fault + "; a spreadsheet has made a date of it: look up what was written";
    }
    return fault + "; write " + written(found.number) + " alone, without " + Quote(found.other);
  }
  return fault;
}

std::string FormatNumber(double value) {
  char digits[64];
  // An easting is 500000 to people, not 5e+05.
  const bool is_plain = std::abs(value) >= 1 && std::abs(value) < 1e15;
  const auto result =
      is_plain ? std::to_chars(digits, digits + sizeof(digits), value, std::chars_format::fixed)
               : std::to_chars(digits, digits + sizeof(digits), value);
  return std::string(digits, result.ptr);
}

std::string Quote(std::string_view word) {
  constexpr size_t kLongest = 40;
  std::string quoted = "'";
  for (const char c : word.substr(0, kLongest)) {
    const unsigned char byte = static_cast<unsigned char>(c);
    quoted += byte < 0x20 || byte == 0x7F ? '?' : c;
  }
  if (word.size() > kLongest) quoted += "...";
  return quoted + "'";
}

bool NaturalLess(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  size_t i = 0;
  size_t k = 0;
  while (i < a.size() && k < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[k])) {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i;
      ++k;
      continue;
    }
    // Compare two numbers of any length: without leading zeros the longer one is greater.
    size_t i_end = i;
    size_t k_end = k;
    while (i_end < a.size() && is_digit(a[i_end])) ++i_end;
    while (k_end < b.size() && is_digit(b[k_end])) ++k_end;
    while (i + 1 < i_end && a[i] == '0') ++i;
    while (k + 1 < k_end && b[k] == '0') ++k;
    if (i_end - i != k_end - k) return i_end - i < k_end - k;
    const int order = a.compare(i, i_end - i, b, k, k_end - k);
    if (order != 0) return order < 0;
    i = i_end;
    k = k_end;
  }
  if (i < a.size() || k < b.size()) return k < b.size();
  return a < b;  // "s01" and "s1" differ only in zeros
}

std::string OneLine(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  while (!message.empty() && message.back() == ' ') message.pop_back();
  return message.empty() ? "unknown reason" : message;
}

}  // namespace groundglass
