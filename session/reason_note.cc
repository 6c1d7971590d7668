// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/reason_note.h"

#include "scene/text.h"

#include <algorithm>
#include <string_view>

namespace groundglass {
namespace {

// Where the line of the reason stands in the text, its break included; nothing: npos.
struct NoteSpan {
  size_t begin = std::string::npos;
  size_t end = std::string::npos;
};

NoteSpan FindReasonLine(const std::string& text) {
  for (size_t at = text.find(kReasonMark); at != std::string::npos;
       at = text.find(kReasonMark, at + 1)) {
    if (at > 0 && text[at - 1] != '\n' && text[at - 1] != '\r') continue;
    size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    if (text.compare(end, 2, "\r\n") == 0) ++end;
    return {at, std::min(end + 1, text.size())};
  }
  return {};
}

}  // namespace

std::string ReasonIn(const std::string& view_text) {
  const NoteSpan line = FindReasonLine(view_text);
  if (line.begin == std::string::npos) return "";
  const size_t begin = line.begin + kReasonMark.size();
  const size_t end = std::min(view_text.find_first_of("\r\n", begin), line.end);
  return std::string(TrimBlanks(std::string_view(view_text).substr(begin, end - begin)));
}

std::string WithReason(const std::string& view_text, const std::string& reason) {
  std::string text = view_text;
  const NoteSpan line = FindReasonLine(text);
  const bool has_one = line.begin != std::string::npos;
  if (has_one) text.erase(line.begin, line.end - line.begin);
  if (reason.empty()) return text;
  std::string note = std::string(kReasonMark) + reason;
  std::replace_if(
      note.begin(), note.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  const std::string line_break = text.find("\r\n") != std::string::npos ? "\r\n" : "\n";
  size_t place = has_one ? line.begin : text.size();
  if (place > 0 && text[place - 1] != '\n' && text[place - 1] != '\r') note = line_break + note;
  return text.insert(place, note + line_break);
}

}  // namespace groundglass
