// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// A word of a text file and where it stands; `text` points into the text that was split.
struct TextToken {
  std::string_view text;
  size_t offset = 0;  // of its first byte in the file
  int line = 0;       // from 1
};

// A line of a text file with `%` comments, its words parted from its comment.
struct TextLine {
  int number = 0;     // from 1
  size_t offset = 0;  // of its first byte in the file
  size_t size = 0;    // in bytes, without the line end
  std::vector<TextToken> tokens;
  bool has_comment = false;
  std::string_view comment;  // after the `%`, without blanks at either end
};

// Splits at \n, \r\n or \r; a byte order mark at the start is skipped. The text must outlive the
// result.
std::vector<TextLine> SplitLines(std::string_view text, char comment_mark = '%');

// A decimal number that fills the whole word, whatever the machine's locale; nothing if it is not
// one. Infinity and overflow come back as infinity, for the caller to refuse.
std::optional<double> ParseNumber(std::string_view word);
std::optional<long long> ParseInteger(std::string_view word);

// What is wrong with a word that should be a finite number, in words that follow `Subject: `; for
// words for which ParseNumber gives nothing, or nothing finite. What it says to write has the
// decimal mark that is usual there: '.' or ','.
std::string WhyNoNumber(std::string_view word);
std::string WhyNoNumber(std::string_view word, char decimal_mark);

// The shortest digits that read back as exactly this number, whatever the machine's locale.
std::string FormatNumber(double value);

// The word in quotes for a message: control bytes as '?', cut after 40 characters.
std::string Quote(std::string_view word);

std::string_view TrimBlanks(std::string_view text);
std::string LowerCase(std::string_view text);

// "s2" < "s10": runs of digits compare as numbers.
bool NaturalLess(const std::string& a, const std::string& b);

// A library's message on one line, without its end of line.
std::string OneLine(std::string message);

}  // namespace groundglass
