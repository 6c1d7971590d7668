// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/continued_lines.h"

#include "scene/text.h"

#include <algorithm>

namespace groundglass {
namespace {

constexpr std::string_view kBlanks = " \t\f\v";

}  // namespace

ContinuedLines::ContinuedLines(std::string_view text) : text_(text) {
  if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
}

std::string_view ContinuedLines::TakeLine() {
  const size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
  const std::string_view line = TrimBlanks(text_.substr(at_, end - at_));
  at_ = end;
  if (at_ < text_.size()) at_ += text_.substr(at_, 2) == "\r\n" ? 2 : 1;
  ++num_lines_;
  return line;
}

bool ContinuedLines::Next() {
  if (at_ >= text_.size()) return false;
  line_ = TakeLine();
  number_ = num_lines_;
  if (line_.empty() || line_.back() != '\\' || line_.front() == '#') return true;
  joined_.clear();
  for (std::string_view part = line_;;) {
    const bool goes_on = !part.empty() && part.back() == '\\' && at_ < text_.size();
    if (!part.empty() && part.back() == '\\') part = TrimBlanks(part.substr(0, part.size() - 1));
    if (!joined_.empty() && !part.empty()) joined_ += ' ';
    joined_ += part;
    if (!goes_on) break;
    part = TakeLine();
  }
  line_ = joined_;
  return true;
}

std::string_view ContinuedLines::keyword() const {
  return line_.substr(0, line_.find_first_of(kBlanks));
}

std::string_view ContinuedLines::rest() const { return TrimBlanks(line_.substr(keyword().size())); }

std::vector<std::string_view> ContinuedLines::arguments() const {
  std::string_view rest_of_line = rest();
  rest_of_line = rest_of_line.substr(0, rest_of_line.find('#'));
  std::vector<std::string_view> words;
  for (size_t start = rest_of_line.find_first_not_of(kBlanks); start < rest_of_line.size();) {
    const size_t end = std::min(rest_of_line.find_first_of(kBlanks, start), rest_of_line.size());
    words.push_back(rest_of_line.substr(start, end - start));
    start = rest_of_line.find_first_not_of(kBlanks, end);
  }
  return words;
}

}  // namespace groundglass
