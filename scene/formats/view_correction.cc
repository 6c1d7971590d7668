// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/error.h"
#include "scene/formats/view_io.h"
#include "scene/formats/view_pairs.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace groundglass {
namespace {

// Two significant digits: a standard deviation is never known better.
std::string FormatDeviation(double deviation) {
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(deviation))), 0, 12);
  const double scale = std::pow(10.0, decimals);
  return FormatNumber(std::round(deviation * scale) / scale);
}

// What the writer leaves in a comment about one corrected number. `key` is given where several
// pairs share the line: "(measured 232, now +-0.03)" or "(x measured 232, now +-0.03)".
struct Note {
  size_t begin = std::string::npos;  // in the text
  size_t end = std::string::npos;
  std::string measured;  // as written at first; empty if it was not measured at all
};

std::string FormatNote(const std::string& key, const std::string& measured, double deviation) {
  std::string note = "(" + (key.empty() ? "" : key + " ");
  note += measured.empty() ? "not measured" : "measured " + measured;
  if (deviation > 0) note += ", now +-" + FormatDeviation(deviation);
  return note + ")";
}

// The note about `key` that an earlier correction left in a comment.
std::optional<Note> FindNote(const std::string& text,
                             size_t begin,
                             size_t end,
                             const std::string& key) {
  for (const std::string& word : {std::string("measured "), std::string("not measured")}) {
    const std::string opening = "(" + (key.empty() ? "" : key + " ") + word;
    for (size_t at = text.find(opening, begin); at != std::string::npos && at < end;
         at = text.find(opening, at + 1)) {
      const size_t close = text.find(')', at);
      if (close == std::string::npos || close >= end) break;
      const size_t value_begin = at + opening.size();
      const size_t value_end = std::min(text.find(',', value_begin), close);
      const std::string value = text.substr(value_begin, value_end - value_begin);
      const bool is_measured = word == "measured ";
      if (is_measured ? ParseNumber(value).has_value() : value.empty()) {
        return Note{at, close + 1, value};
      }
    }
  }
  return std::nullopt;
}

struct Edit {
  size_t begin = 0;
  size_t end = 0;
  std::string replacement;
};

std::string ApplyEdits(std::string text, std::vector<Edit> edits) {
  std::stable_sort(
      edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit) {
    text.replace(edit->begin, edit->end - edit->begin, edit->replacement);
  }
  return text;
}

// Where a line's comment text ends: before its trailing blanks.
size_t EndOfWords(const std::string& text, const TextLine& line) {
  size_t end = line.offset + line.size;
  while (end > line.offset && (text[end - 1] == ' ' || text[end - 1] == '\t')) --end;
  return end;
}

// What changes on one line: its values, and the notes of what they were.
void EditLine(const std::string& measured_text,
              const ViewReading& reading,
              const ViewTag& corrected,
              const TagDeviations& deviations,
              const TextLine& line,
              std::vector<Edit>& edits) {
  // A note belongs to the line on which its value stands.
  std::vector<const KeyValue*> pairs;
  for (const KeyValue& pair : reading.pairs) {
    if (pair.value.line == line.number) pairs.push_back(&pair);
  }
  const auto replace_value = [&](const TextToken& value, double number) {
    edits.push_back({value.offset, value.offset + value.text.size(), FormatNumber(number)});
  };
  const size_t comment_begin = line.tokens.empty()
                                   ? line.offset
                                   : line.tokens.back().offset + line.tokens.back().text.size();
  const size_t line_end = EndOfWords(measured_text, line);
  std::string new_notes;
  for (const KeyValue* pair : pairs) {
    if (const SigmaKey* sigma_key = FindSigmaKey(pair->key.text)) {
      const std::optional<double>& sigma = corrected.sigmas.*(sigma_key->member);
      if (sigma && *sigma != ParseNumber(pair->value.text)) replace_value(pair->value, *sigma);
    }
    const std::optional<TagKey> key = FindTagKey(pair->key.text);
    if (!key) continue;
    const double value = GetTagValue(corrected, *key);
    const double deviation = deviations[static_cast<int>(*key)];
    const bool is_changed = value != GetTagValue(reading.tag, *key);
    if (is_changed) replace_value(pair->value, value);
    const std::string note_key = pairs.size() > 1 ? std::string(pair->key.text) : "";
    if (const auto note = FindNote(measured_text, comment_begin, line_end, note_key)) {
      if (is_changed || deviation > 0) {
        edits.push_back({note->begin, note->end, FormatNote(note_key, note->measured, deviation)});
      }
    } else if (is_changed) {
      new_notes += " " + FormatNote(note_key, std::string(pair->value.text), deviation);
    }
  }
  if (new_notes.empty()) return;
  edits.push_back({line_end, line_end, (line.has_comment ? "" : " %") + new_notes});
}

std::string LineBreakOf(const std::string& text) {
  if (text.find("\r\n") != std::string::npos) return "\r\n";
  const bool has_only_returns =
      text.find('\n') == std::string::npos && text.find('\r') != std::string::npos;
  return has_only_returns ? "\r" : "\n";
}

// Lines for what the file has no key of.
std::string FormatNewKeys(const ViewReading& reading,
                          const ViewTag& corrected,
                          const TagDeviations& deviations,
                          const std::string& line_break) {
  std::string text;
  for (int index = 0; index < kNumTagKeys; ++index) {
    const double value = GetTagValue(corrected, static_cast<TagKey>(index));
    const bool is_needed = index < kNumRequiredKeys || value != 0;
    if (!is_needed || FindPair(reading.pairs, kTagKeyNames[index]) != nullptr) continue;
    text += std::string(kTagKeyNames[index]) + " " + FormatNumber(value) + " % " +
            FormatNote("", "", deviations[index]) + line_break;
  }
  for (const SigmaKey& key : kSigmaKeys) {
    const std::optional<double>& sigma = corrected.sigmas.*(key.member);
    if (!sigma || FindPair(reading.pairs, key.name) != nullptr) continue;
    text += std::string(key.name) + " " + FormatNumber(*sigma) + line_break;
  }
  if (!corrected.camera.empty() && reading.tag.camera.empty()) {
    text += std::string(kCameraKey) + " " + corrected.camera + line_break;
  }
  return text;
}

}  // namespace

std::string FormatCorrectedView(const std::string& measured_text,
                                const ViewTag& corrected,
                                const TagDeviations& deviations) {
  const ViewReading reading = ReadSomePairs(measured_text, "view");
  if (!reading.faults.empty()) throw Error(reading.faults.front());
  std::vector<Edit> edits;
  for (const TextLine& line : reading.lines) {
    EditLine(measured_text, reading, corrected, deviations, line, edits);
  }
  std::string text = ApplyEdits(measured_text, edits);
  const std::string line_break = LineBreakOf(measured_text);
  const std::string appended = FormatNewKeys(reading, corrected, deviations, line_break);
  if (!appended.empty() && !text.empty() && text.back() != '\n' && text.back() != '\r') {
    text += line_break;
  }
  return text + appended;
}

}  // namespace groundglass
