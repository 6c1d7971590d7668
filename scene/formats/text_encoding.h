// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace groundglass {

bool IsUtf8(std::string_view bytes);
// Whether it is UTF-16, with its mark or, of plain letters, without.
bool IsUtf16(std::string_view bytes);

// A text as UTF-8, without byte order mark, however it was saved: as UTF-8, UTF-16 (Excel's
// "Unicode text"), or, where it is neither, Windows-1252, which holds Latin-1.
struct Utf8Text {
  std::string text;
  bool is_guessed = false;  // neither UTF-8 nor marked as UTF-16: read as Windows-1252
};
Utf8Text Utf8FromBytes(std::string_view bytes);

// A text as Windows-1252, which fonts of PDF have. What that has not becomes '?', and is added to
// `missing`.
std::string Windows1252FromUtf8(std::string_view utf8, std::set<std::string>& missing);
// Big-endian, with the mark before it.
std::string Utf16FromUtf8(std::string_view utf8);

// How many columns of a terminal a text takes.
int DisplayWidth(std::string_view utf8);
// The text with blanks behind it, so that it takes at least this many columns.
std::string PaddedTo(int width, std::string_view utf8);

// A name such that two names that a person takes for the same are equal: letters composed in one
// way (macOS parts "ü" in two) and without upper case.
std::string FoldedName(std::string_view name);

}  // namespace groundglass
