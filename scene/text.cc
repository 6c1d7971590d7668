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
