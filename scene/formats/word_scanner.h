// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string_view>

namespace groundglass {

// Hands out the words of a text one after the other, whatever parts them, without taking memory
// for more than one.
class WordScanner {
 public:
  // `line`: of the text's first byte in its file.
  explicit WordScanner(std::string_view text, int line = 1) : text_(text), line_(line) {}

  // The next word; empty at the end.
  std::string_view Next() {
    SkipBlanks(false);
    const size_t start = at_;
    while (at_ < text_.size() && !IsBlank(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }
  // What is left of this line, without blanks at its ends.
  std::string_view RestOfLine() {
    SkipBlanks(true);
    const size_t start = at_;
    while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
    std::string_view rest = text_.substr(start, at_ - start);
    while (!rest.empty() && IsBlank(rest.back())) rest.remove_suffix(1);
    return rest;
  }
  // Of the word handed out last.
  int line() const { return line_; }
  size_t NumBytesLeft() const { return text_.size() - at_; }

 private:
  static bool IsBlank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
  }
  void SkipBlanks(bool within_line) {
    while (at_ < text_.size() && IsBlank(text_[at_])) {
      const char c = text_[at_];
      if (c == '\n' || c == '\r') {
        if (within_line) return;
        const bool is_second_half = c == '\n' && at_ > 0 && text_[at_ - 1] == '\r';
        if (!is_second_half) ++line_;
      }
      ++at_;
    }
  }

  std::string_view text_;
  size_t at_ = 0;
  int line_;
};

}  // namespace groundglass
