// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/view_io.h"

#include "scene/error.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

namespace groundglass {
namespace {

constexpr std::string_view kCameraKey = "camera";
// In place of a value that is yet to be written (FormatViewTemplate).
constexpr std::string_view kToBeFilledIn = "?";
// x y z i j k a v: without them there is no camera.
constexpr int kNumRequiredKeys = 8;

std::optional<TagKey> FindTagKey(std::string_view name) {
  const auto found = std::find(kTagKeyNames.begin(), kTagKeyNames.end(), name);
  if (found == kTagKeyNames.end()) return std::nullopt;
  return static_cast<TagKey>(found - kTagKeyNames.begin());
}

const SigmaKey* FindSigmaKey(std::string_view name) {
  const auto found = std::find_if(
      kSigmaKeys.begin(), kSigmaKeys.end(), [&](const SigmaKey& key) { return key.name == name; });
  return found == kSigmaKeys.end() ? nullptr : &*found;
}

bool IsKey(std::string_view name) {
  return FindTagKey(name) || FindSigmaKey(name) != nullptr || name == kCameraKey;
}

struct KeyValue {
  TextToken key;
  TextToken value;
};

struct ViewReading {
  ViewTag tag;
  std::vector<TextLine> lines;
  std::vector<KeyValue> pairs;
  std::vector<std::string> faults;
};

const KeyValue* FindPair(const std::vector<KeyValue>& pairs, std::string_view key) {
  const auto found = std::find_if(
      pairs.begin(), pairs.end(), [&](const KeyValue& pair) { return pair.key.text == key; });
  return found == pairs.end() ? nullptr : &*found;
}

// The number that follows a sign which stands by itself, as in `y - 74.9`; empty if none does.
std::string_view NumberAfterSign(const std::vector<TextToken>& tokens, size_t sign) {
  const std::string_view text = tokens[sign].text;
  if ((text != "-" && text != "+") || sign + 1 >= tokens.size()) return {};
  const std::string_view next = tokens[sign + 1].text;
  return !next.empty() && next[0] != '-' && next[0] != '+' && ParseNumber(next)
             ? next
             : std::string_view();
}

void StoreValue(const KeyValue& pair, double value, ViewTag& tag) {
  if (const std::optional<TagKey> key = FindTagKey(pair.key.text)) {
    SetTagValue(tag, *key, value);
  } else {
    tag.sigmas.*(FindSigmaKey(pair.key.text)->member) = value;
  }
}

// Reads everything it can; faults in the order of the file.
ViewReading ReadPairs(const std::string& text, const std::filesystem::path& name) {
  ViewReading reading;
  reading.lines = SplitLines(text);
  std::vector<TextToken> tokens;
  for (const TextLine& line : reading.lines) {
    tokens.insert(tokens.end(), line.tokens.begin(), line.tokens.end());
  }
  const auto fail = [&](int line, const std::string& message) {
    reading.faults.push_back(Error(name, line, message).what());
  };
  std::string to_fill_in;
  int first_to_fill_in = 0;
  for (size_t i = 0; i < tokens.size(); ++i) {
    const TextToken& key = tokens[i];
    const bool has_value = i + 1 < tokens.size() && !IsKey(tokens[i + 1].text);
    if (!IsKey(key.text)) {
      fail(key.line,
           "unknown key " + Quote(key.text) +
               "; the keys are x y z i j k a v roll shift_x shift_y k1 k2 k3 p1 p2 sigma_... "
               "camera");
      if (has_value) ++i;
      continue;
    }
    const std::string key_name = "key " + Quote(key.text);
    if (!has_value && !(key.text == kCameraKey && i + 1 < tokens.size())) {
      fail(key.line, key_name + " has no value");
      continue;
    }
    const KeyValue pair{key, tokens[++i]};
    if (const std::string_view number = NumberAfterSign(tokens, i); !number.empty()) {
      fail(pair.value.line,
           key_name + ": a blank stands between the sign and the number; write " +
               std::string(pair.value.text) + std::string(number));
      reading.pairs.push_back(pair);
      ++i;
      continue;
    }
    if (const KeyValue* first = FindPair(reading.pairs, key.text)) {
      fail(key.line,
           key_name + " is repeated; it stands on line " + std::to_string(first->key.line) +
               " already");
      continue;
    }
    reading.pairs.push_back(pair);
    if (pair.value.text == kToBeFilledIn) {
      if (to_fill_in.empty()) first_to_fill_in = key.line;
      to_fill_in += (to_fill_in.empty() ? "" : ", ") + std::string(key.text);
      continue;
    }
    if (key.text == kCameraKey) {
      reading.tag.camera = pair.value.text;
      continue;
    }
    const std::optional<double> value = ParseNumber(pair.value.text);
    if (!value) {
      fail(pair.value.line, key_name + ": " + Quote(pair.value.text) + " is not a number");
    } else if (!std::isfinite(*value)) {
      fail(pair.value.line, key_name + ": " + Quote(pair.value.text) + " is not a finite number");
    } else if (FindSigmaKey(key.text) != nullptr && !(*value > 0)) {
      fail(pair.value.line, key_name + ": a standard deviation must be above 0");
    } else {
      StoreValue(pair, *value, reading.tag);
    }
  }
  if (!to_fill_in.empty()) {
    fail(first_to_fill_in,
         "this template is not filled in yet: write a number in place of the ? of " + to_fill_in);
  }
  for (int index = 0; index < kNumRequiredKeys; ++index) {
    if (FindPair(reading.pairs, kTagKeyNames[index]) == nullptr) {
      reading.faults.push_back(
          Error(name, "key " + Quote(kTagKeyNames[index]) + " is missing").what());
    }
  }
  if (reading.faults.empty()) {
    if (const std::optional<TagFault> fault = FindTagFault(reading.tag)) {
      const KeyValue* pair = FindPair(reading.pairs, fault->key);
      fail(pair == nullptr ? 1 : pair->key.line,
           "key " + Quote(fault->key) + ": " + fault->message);
    }
  }
  return reading;
}

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

}  // namespace

std::string ReadTextFile(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw Error(file, "this is a folder; expected a text file");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file, "cannot open this file");
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (in.bad() || (bytes.fail() && in.peek() != std::ifstream::traits_type::eof())) {
    throw Error(file, "cannot read this file");
  }
  return std::move(bytes).str();
}

ViewTag ParseView(const std::string& text, const std::filesystem::path& name) {
  ViewReading reading = ReadPairs(text, name);
  if (!reading.faults.empty()) throw Error(reading.faults.front());
  return reading.tag;
}

ViewTag ReadView(const std::filesystem::path& file) { return ParseView(ReadTextFile(file), file); }

std::vector<std::string> FindViewFaults(const std::string& text,
                                        const std::filesystem::path& name) {
  return ReadPairs(text, name).faults;
}

std::string FormatView(const ViewTag& tag, const std::string& comment) {
  std::string text;
  std::istringstream comment_lines(comment);
  for (std::string line; std::getline(comment_lines, line);) text += "% " + line + "\n";
  for (int index = 0; index < kNumTagKeys; ++index) {
    const double value = GetTagValue(tag, static_cast<TagKey>(index));
    if (index >= kNumRequiredKeys && value == 0) continue;
    text += std::string(kTagKeyNames[index]) + " " + FormatNumber(value) + "\n";
  }
  for (const SigmaKey& key : kSigmaKeys) {
    const std::optional<double>& sigma = tag.sigmas.*(key.member);
    if (sigma) text += std::string(key.name) + " " + FormatNumber(*sigma) + "\n";
  }
  if (!tag.camera.empty()) {
    if (tag.camera.find_first_of(" \t\r\n%") != std::string::npos) {
      throw Error("camera name " + Quote(tag.camera) + " must be one word without '%'");
    }
    text += std::string(kCameraKey) + " " + tag.camera + "\n";
  }
  return text;
}

std::string FormatCorrectedView(const std::string& measured_text,
                                const ViewTag& corrected,
                                const TagDeviations& deviations) {
  const ViewReading reading = ReadPairs(measured_text, "view");
  if (!reading.faults.empty()) throw Error(reading.faults.front());

  std::vector<Edit> edits;
  for (const TextLine& line : reading.lines) {
    // A note belongs to the line on which its value stands.
    std::vector<const KeyValue*> pairs;
    for (const KeyValue& pair : reading.pairs) {
      if (pair.value.line == line.number) pairs.push_back(&pair);
    }
    const size_t comment_begin = line.tokens.empty()
                                     ? line.offset
                                     : line.tokens.back().offset + line.tokens.back().text.size();
    const size_t line_end = EndOfWords(measured_text, line);
    std::string new_notes;
    for (const KeyValue* pair : pairs) {
      if (const SigmaKey* sigma_key = FindSigmaKey(pair->key.text)) {
        const std::optional<double>& sigma = corrected.sigmas.*(sigma_key->member);
        if (sigma && *sigma != ParseNumber(pair->value.text)) {
          edits.push_back({pair->value.offset,
                           pair->value.offset + pair->value.text.size(),
                           FormatNumber(*sigma)});
        }
      }
      const std::optional<TagKey> key = FindTagKey(pair->key.text);
      if (!key) continue;
      const double value = GetTagValue(corrected, *key);
      const double deviation = deviations[static_cast<int>(*key)];
      const bool is_changed = value != GetTagValue(reading.tag, *key);
      if (is_changed) {
        edits.push_back({pair->value.offset,
                         pair->value.offset + pair->value.text.size(),
                         FormatNumber(value)});
      }
      const std::string note_key = pairs.size() > 1 ? std::string(pair->key.text) : "";
      if (const auto note = FindNote(measured_text, comment_begin, line_end, note_key)) {
        if (is_changed || deviation > 0) {
          edits.push_back(
              {note->begin, note->end, FormatNote(note_key, note->measured, deviation)});
        }
      } else if (is_changed) {
        new_notes += " " + FormatNote(note_key, std::string(pair->value.text), deviation);
      }
    }
    if (new_notes.empty()) continue;
    edits.push_back({line_end, line_end, (line.has_comment ? "" : " %") + new_notes});
  }

  std::string text = ApplyEdits(measured_text, edits);
  const std::string line_break = measured_text.find("\r\n") != std::string::npos
                                     ? "\r\n"
                                     : (measured_text.find('\n') == std::string::npos &&
                                                measured_text.find('\r') != std::string::npos
                                            ? "\r"
                                            : "\n");
  std::string appended;
  for (int index = kNumRequiredKeys; index < kNumTagKeys; ++index) {
    const double value = GetTagValue(corrected, static_cast<TagKey>(index));
    if (value == 0 || FindPair(reading.pairs, kTagKeyNames[index]) != nullptr) continue;
    appended += std::string(kTagKeyNames[index]) + " " + FormatNumber(value) + " % " +
                FormatNote("", "", deviations[index]) + line_break;
  }
  for (const SigmaKey& key : kSigmaKeys) {
    const std::optional<double>& sigma = corrected.sigmas.*(key.member);
    if (!sigma || FindPair(reading.pairs, key.name) != nullptr) continue;
    appended += std::string(key.name) + " " + FormatNumber(*sigma) + line_break;
  }
  if (!corrected.camera.empty() && reading.tag.camera.empty()) {
    appended += std::string(kCameraKey) + " " + corrected.camera + line_break;
  }
  if (!appended.empty() && !text.empty() && text.back() != '\n' && text.back() != '\r') {
    text += line_break;
  }
  return text + appended;
}

}  // namespace groundglass
