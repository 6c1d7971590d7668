// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// Hands out the lines of an OBJ or MTL file, without blanks at their ends; a line that ends in a
// backslash goes on in the next.
class ContinuedLines {
 public:
  explicit ContinuedLines(std::string_view text);

  // False at the end. Views stay good until the next call.
  bool Next();
  std::string_view text() const { return line_; }
  // Of the line's first part, from 1.
  int number() const { return number_; }

  // The first word, and what follows it.
  std::string_view keyword() const;
  std::string_view rest() const;
  // All words but for the first, up to a comment.
  std::vector<std::string_view> arguments() const;

 private:
  std::string_view TakeLine();

  std::string_view text_;
  size_t at_ = 0;
  int num_lines_ = 0;
  int number_ = 0;
  std::string_view line_;
  std::string joined_;
};

}  // namespace groundglass
